#include "support/statistics.hpp"

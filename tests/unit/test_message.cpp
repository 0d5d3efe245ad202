// Numbers in messages, as people write them.
#include "base/message.hpp"
#include "support/catch.hpp"

using namespace lichtmc;

TEST_CASE("numbers in messages have few digits and no exponents of programs") {
  CHECK(short_number(0.0) == "0");
  CHECK(short_number(2.5) == "2.5");
  CHECK(short_number(0.12345) == "0.123");
  CHECK(short_number(9.996) == "10");
  CHECK(short_number(13270.0) == "13300");
  CHECK(rounded(13270.0, 4) == "13270");
  CHECK(short_number(999600.0) == "1000000");
  CHECK(short_number(-45.77e-6) == "-0.0000458");
  CHECK(short_number(1.6e13) == "1.6·10¹³");
  CHECK(short_number(1.26e-9) == "1.26·10⁻⁹");
  CHECK(decimal(2.50004, 3) == "2.5");
  CHECK(decimal(-3.904e-5, 3) == "0");
  CHECK(decimal(692000.25, 3) == "692000.25");
}

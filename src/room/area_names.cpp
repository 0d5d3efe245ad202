#include "lichtmc/area.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc {

std::string_view to_string(AreaQuantity quantity) {
  switch (quantity) {
    case AreaQuantity::normal:
      return "normal";
    case AreaQuantity::horizontal:
      return "horizontal";
    case AreaQuantity::cylindrical:
      return "cylindrical";
    case AreaQuantity::semicylindrical:
      return "semicylindrical";
  }
  return "";
}

std::string_view to_string(ReceiverLaw law) {
  switch (law) {
    case ReceiverLaw::planar:
      return "planar";
    case ReceiverLaw::cylindrical:
      return "cylindrical";
    case ReceiverLaw::semicylindrical:
      return "semicylindrical";
  }
  return "";
}

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::none:
      return "";
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::undecided:
      return "undecided";
  }
  return "";
}

}  // namespace lichtmc

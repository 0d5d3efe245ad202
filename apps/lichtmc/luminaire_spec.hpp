// Luminaires with photometric files on the command line: --light ies:FILE:X,Y,Z…
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "lichtmc/photometry.hpp"
#include "lichtmc/room.hpp"

namespace lichtmc::app {

// Adds luminaires to a room. Each file is read once.
class LuminaireSpecs {
 public:
  // description: ies:FILE:X,Y,Z[:NX,NY,NZ[:ROTATION]] and then, in any order, [:lm=LM|x=FACTOR|W=WATTS][:set=N][:area]
  // [:flip-h]. FILE is relative to the working folder and has no ":". NX,NY,NZ: its aim, default 0,-1,0. ROTATION:
  // degrees about its aim, from C0 towards C90. The emitter has the name of the file without its ending, and a number
  // if that is taken. Throws InputError naming the description and what is wrong in it.
  void add(Room& room, const std::string& description);

 private:
  using Key = std::tuple<std::string, std::size_t, bool, bool>;
  std::map<Key, std::shared_ptr<const Photometry>> files_;
};

}  // namespace lichtmc::app

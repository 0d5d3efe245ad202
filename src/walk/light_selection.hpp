// Which emitter a light sample takes, if there are too many to take all: a probability for each, which depends on the
// place.
//
// In each cell of the room's surfaces (place_tree.hpp) three choices are mixed: by a table of the emitters that light
// the cell, by a table of those that light its region, and by flux: q = s·cell + (1 − a − s)·region + a·flux/Σ flux.
// The last keeps every probability above 0, so that estimates are unbiased whatever the tables say; the second keeps
// scores low where a cell reaches through a wall, in buildings with very many emitters, too, and serves emitters for
// which the table of the cell is too short. Where there is no table, the choice is by flux alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "walk/place_tree.hpp"

namespace lichtmc {

class LightSelection {
 public:
  struct Choice {
    std::size_t emitter = 0;
    double probability = 1.0;  // as probability() gives it, to the last bit
  };

  // The weight of an emitter in the table of a cell: ≥ 0 and finite, in any unit.
  struct Weight {
    std::uint32_t emitter = 0;
    double weight = 0.0;
  };

  // By flux alone: one cell. fluxes: of the emitters, numbered as here; above 0, in any unit.
  explicit LightSelection(const std::vector<double>& fluxes);

  // Tables of each cell and each region: emitters ascending, each at most once; empty if there is no light.
  struct CellTable {
    std::vector<Weight> weights;
    double share = 1.0;  // of the cell's light that comes from the emitters of its table: 0 … 1
  };
  struct Tables {
    std::vector<CellTable> of_cells;
    std::vector<std::vector<Weight>> of_regions;
  };
  LightSelection(const std::vector<double>& fluxes, PlaceTree cells, const Tables& tables);

  // The number of the cell of a point on a surface: in m; normal of the side, of length 1.
  std::uint32_t cell_of(const glm::dvec3& point, const glm::dvec3& normal) const {
    return cells_.cell_of(point, normal);
  }

  // An emitter by u, uniform in [0, 1).
  Choice choose(std::uint32_t cell, double u) const;
  // The probability with which choose() takes an emitter. They sum to 1 in each cell, up to rounding.
  double probability(std::uint32_t cell, std::size_t emitter) const;

 private:
  struct Entry {
    std::uint32_t emitter = 0;
    std::uint32_t from = 0;  // sum of the probabilities of the entries before it, in units of 2⁻³²
  };
  // Entries begin … end − 1; none in an empty table.
  struct Table {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    bool is_empty() const { return begin == end; }
  };

  struct CellTables {
    Table cell;
    Table region;
    double share = 0.0;  // s
  };

  Table add_table(const std::vector<Weight>& weights);
  std::size_t choose_from(const Table& table, double u) const;
  double probability_in(const Table& table, std::size_t emitter) const;

  std::vector<double> by_flux_;     // flux/Σ flux
  std::vector<double> flux_up_to_;  // for choose()
  PlaceTree cells_;
  std::vector<CellTables> tables_;  // of each cell, and empty ones for places without cell
  std::vector<Entry> entries_;
};

}  // namespace lichtmc

#include "room/grow_parts.hpp"

#include <algorithm>
#include <bit>
#include <queue>
#include <utility>

namespace lichtmc {

namespace {

constexpr std::uint32_t no_number = 0xFFFFFFFF;

// Numbers of a patch's triangles, by their index in the surface.
class NumbersInPatch {
 public:
  explicit NumbersInPatch(const std::vector<std::uint32_t>& triangles)
      : triangles_(triangles), table_(std::bit_ceil(2 * triangles.size() + 1), no_number) {
    for (std::uint32_t n = 0; n < triangles.size(); ++n) table_[slot(triangles[n])] = n;
  }
  // none if the triangle is not part of the patch.
  std::uint32_t of(std::uint32_t triangle) const { return table_[slot(triangle)]; }

 private:
  // The place of a triangle, or the empty one where it would be. The factor spreads numbers (2⁶⁴ over the golden
  // ratio).
  std::size_t slot(std::uint32_t triangle) const {
    std::size_t at = (triangle * 0x9E3779B97F4A7C15U >> 32U) & (table_.size() - 1);
    while (table_[at] != no_number && triangles_[table_[at]] != triangle) at = (at + 1) & (table_.size() - 1);
    return at;
  }

  const std::vector<std::uint32_t>& triangles_;
  std::vector<std::uint32_t> table_;
};

// The order of pairs that save the same: those of smaller numbers first.
struct Saving {
  double gain = 0.0;
  std::uint32_t a = 0;  // < b
  std::uint32_t b = 0;
  bool operator<(const Saving& other) const {
    if (gain != other.gain) return gain < other.gain;
    return std::pair(a, b) > std::pair(other.a, other.b);
  }
};

// A pair's saving changes only when a rectangle changes. A part that has been joined keeps its pairs in a heap of its
// own: it is made anew when the rectangle changes, and only gets new neighbours when it does not. The common queue has
// the pairs of single triangles, and the best pair of each part.
class Parts {
 public:
  Parts(const Patch& patch, const std::vector<bool>& counts, const MeshLinks& links, double edge_m);
  std::vector<std::vector<std::size_t>> grow();
  std::uint64_t evaluated() const { return evaluated_; }

 private:
  struct Candidate {
    Saving saving;
    std::uint32_t version = 0;  // of the other part
    bool operator<(const Candidate& other) const { return saving < other.saving; }
  };
  struct Part {
    FlatRectangle bounds;
    double cost = 0.0;                      // of the bounds
    std::vector<std::uint32_t> neighbours;  // triangles beside a part that has been joined, some of them several times
    std::vector<Candidate> candidates;      // heap; of a part that has been joined
    std::uint32_t first = 0;                // of its triangles, a chain
    std::uint32_t last = 0;
    std::uint32_t count = 1;
    std::uint32_t version = 0;  // increases when the bounds change, and when it is joined into another part
    std::uint32_t ticket = 0;   // increases when its best pair enters the queue: those before no longer count
  };
  struct Entry {
    Saving saving;
    std::uint32_t version_a = 0;
    std::uint32_t version_b = 0;
    std::uint32_t owner = no_number;  // the part whose best pair it is
    std::uint32_t ticket = 0;
    bool operator<(const Entry& other) const { return saving < other.saving; }
  };

  double cost(const FlatRectangle& bounds) const;
  // Whether a and b may be joined, and what that saves.
  bool evaluate(std::uint32_t a, std::uint32_t b, Saving& saving);
  std::uint32_t part_of(std::uint32_t triangle);
  void add_neighbours(std::uint32_t part, std::vector<std::uint32_t>& neighbours) const;
  void join(std::uint32_t a, std::uint32_t b);
  void consider(std::uint32_t part, std::uint32_t other);
  void consider_all(std::uint32_t part);
  void offer(std::uint32_t part);

  const Patch& patch_;
  const MeshLinks& links_;
  NumbersInPatch numbers_;
  double edge_m_;
  std::vector<Part> parts_;  // numbered by one of their triangles
  std::vector<std::uint32_t> joined_into_;
  std::vector<std::uint32_t> next_;  // triangle of the same part
  std::vector<std::uint32_t> seen_by_;
  std::uint32_t passes_ = 0;
  std::priority_queue<Entry> queue_;
  std::uint64_t evaluated_ = 0;
};

Parts::Parts(const Patch& patch, const std::vector<bool>& counts, const MeshLinks& links, double edge_m)
    : patch_(patch),
      links_(links),
      numbers_(patch.triangles),
      edge_m_(edge_m),
      parts_(patch.triangles.size()),
      joined_into_(parts_.size(), no_number),
      next_(parts_.size(), no_number),
      seen_by_(parts_.size(), 0) {
  for (std::uint32_t n = 0; n < parts_.size(); ++n) {
    Part& part = parts_[n];
    if (counts[n]) part.bounds.add(patch.flat[n]);
    part.cost = cost(part.bounds);
    part.first = part.last = n;
  }
  std::vector<Entry> first;
  std::vector<std::uint32_t> neighbours;
  for (std::uint32_t n = 0; n < parts_.size(); ++n) {
    neighbours.clear();
    add_neighbours(n, neighbours);
    for (const std::uint32_t other : neighbours) {
      Entry entry;
      if (other > n && evaluate(n, other, entry.saving)) first.push_back(entry);
    }
  }
  queue_ = std::priority_queue<Entry>(std::less<Entry>(), std::move(first));
}

// Cells, not rounded, but no less than one each way.
double Parts::cost(const FlatRectangle& bounds) const {
  if (bounds.empty()) return 0.0;
  const glm::dvec2 cells = glm::max((bounds.high - bounds.low) / edge_m_, glm::dvec2(1.0));
  return cells.x * cells.y;
}

bool Parts::evaluate(std::uint32_t a, std::uint32_t b, Saving& saving) {
  ++evaluated_;
  if (a > b) std::swap(a, b);
  FlatRectangle both = parts_[a].bounds;
  both.add(parts_[b].bounds);
  // A loss within rounding is allowed, so that slivers and strips in line are joined.
  constexpr double rounding = 1e-9;
  const double together = cost(both);
  saving = {parts_[a].cost + parts_[b].cost - together, a, b};
  return saving.gain >= -rounding * together;
}

std::uint32_t Parts::part_of(std::uint32_t triangle) {
  while (joined_into_[triangle] != no_number) {
    const std::uint32_t into = joined_into_[triangle];
    if (joined_into_[into] != no_number) joined_into_[triangle] = joined_into_[into];
    triangle = into;
  }
  return triangle;
}

// Appends the triangles of the patch beside a part; those of a single triangle are not stored.
void Parts::add_neighbours(std::uint32_t part, std::vector<std::uint32_t>& neighbours) const {
  if (parts_[part].count > 1) {
    neighbours.insert(neighbours.end(), parts_[part].neighbours.begin(), parts_[part].neighbours.end());
    return;
  }
  for (std::size_t edge = 0; edge < 3; ++edge) {
    for (const std::uint32_t triangle : links_.at_edge(patch_.triangles[part], edge)) {
      const std::uint32_t neighbour = numbers_.of(triangle);
      if (neighbour != no_number && neighbour != part) neighbours.push_back(neighbour);
    }
  }
}

void Parts::consider(std::uint32_t part, std::uint32_t other) {
  Candidate candidate;
  if (!evaluate(part, other, candidate.saving)) return;
  candidate.version = parts_[other].version;
  parts_[part].candidates.push_back(candidate);
}

// Each neighbour once. The list then has one triangle of each.
void Parts::consider_all(std::uint32_t part) {
  ++passes_;
  Part& own = parts_[part];
  own.candidates.clear();
  std::size_t kept = 0;
  for (const std::uint32_t triangle : own.neighbours) {
    const std::uint32_t other = part_of(triangle);
    if (other == part || seen_by_[other] == passes_) continue;
    seen_by_[other] = passes_;
    own.neighbours[kept++] = other;
    consider(part, other);
  }
  own.neighbours.resize(kept);
  std::make_heap(own.candidates.begin(), own.candidates.end());
}

// Puts the best pair of a part that has been joined into the queue.
void Parts::offer(std::uint32_t part) {
  Part& own = parts_[part];
  ++own.ticket;
  while (!own.candidates.empty()) {
    const Candidate& best = own.candidates.front();
    const std::uint32_t other = best.saving.a == part ? best.saving.b : best.saving.a;
    if (best.version == parts_[other].version) {
      Entry entry{best.saving, own.version, own.version, part, own.ticket};
      (best.saving.a == part ? entry.version_b : entry.version_a) = best.version;
      queue_.push(entry);
      return;
    }
    std::pop_heap(own.candidates.begin(), own.candidates.end());
    own.candidates.pop_back();
  }
}

void Parts::join(std::uint32_t a, std::uint32_t b) {
  if (parts_[a].count < parts_[b].count) std::swap(a, b);
  Part& large = parts_[a];
  Part& small = parts_[b];
  const FlatRectangle before = large.bounds;
  large.bounds.add(small.bounds);
  if (large.count == 1) add_neighbours(a, large.neighbours);
  const auto fresh = static_cast<std::ptrdiff_t>(large.neighbours.size());
  add_neighbours(b, large.neighbours);
  next_[large.last] = small.first;
  large.last = small.last;
  large.count += small.count;
  joined_into_[b] = a;
  ++small.version;
  small.neighbours = {};
  small.candidates = {};
  if (large.bounds.low != before.low || large.bounds.high != before.high) {
    large.cost = cost(large.bounds);
    ++large.version;
    consider_all(a);
  } else {
    for (auto k = fresh; k < static_cast<std::ptrdiff_t>(large.neighbours.size()); ++k) {
      const std::uint32_t other = part_of(large.neighbours[static_cast<std::size_t>(k)]);
      if (other == a) continue;
      const std::size_t count = large.candidates.size();
      consider(a, other);
      if (large.candidates.size() > count) std::push_heap(large.candidates.begin(), large.candidates.end());
    }
  }
  offer(a);
}

std::vector<std::vector<std::size_t>> Parts::grow() {
  while (!queue_.empty()) {
    const Entry best = queue_.top();
    queue_.pop();
    if (best.owner != no_number && parts_[best.owner].ticket != best.ticket) continue;
    const bool holds =
        parts_[best.saving.a].version == best.version_a && parts_[best.saving.b].version == best.version_b;
    if (holds) {
      join(best.saving.a, best.saving.b);
    } else if (best.owner != no_number && joined_into_[best.owner] == no_number) {
      offer(best.owner);
    }
  }
  std::vector<std::vector<std::size_t>> grown;
  std::vector<std::size_t> without_bounds;
  for (std::uint32_t n = 0; n < parts_.size(); ++n) {
    if (joined_into_[n] != no_number) continue;
    std::vector<std::size_t>& triangles = parts_[n].bounds.empty() ? without_bounds : grown.emplace_back();
    for (std::uint32_t k = parts_[n].first; k != no_number; k = next_[k]) triangles.push_back(k);
  }
  grown.front().insert(grown.front().end(), without_bounds.begin(), without_bounds.end());
  return grown;
}

}  // namespace

std::vector<std::vector<std::size_t>> grow_parts(const Patch& patch, const std::vector<bool>& counts,
                                                 const MeshLinks& links, double edge_m, std::uint64_t* evaluated) {
  Parts parts(patch, counts, links, edge_m);
  std::vector<std::vector<std::size_t>> grown = parts.grow();
  if (evaluated != nullptr) *evaluated += parts.evaluated();
  return grown;
}

}  // namespace lichtmc

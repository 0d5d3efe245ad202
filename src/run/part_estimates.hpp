// The parts of groups of emitters, from the sums of a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lichtmc/communicator.hpp"
#include "lichtmc/emitter_parts.hpp"
#include "lichtmc/result.hpp"
#include "run/backward_work.hpp"
#include "walk/emitter_groups.hpp"

namespace lichtmc {

// The groups of a run, and their direct light.
class LightOfParts {
 public:
  LightOfParts(const Room& room, const Settings& settings);

  // Null if no parts are kept.
  const EmitterGroups* groups() const { return groups_ ? &*groups_ : nullptr; }
  // Number of groups; 0 if no parts are kept.
  std::uint32_t size() const { return groups_ ? groups_->size() : 0; }

  // Computes the direct light of a receiver and keeps its parts. compute(of_emitters): all of it; adds that of each
  // emitter to *of_emitters, unless that is null. Returns the sum of the parts. For one receiver at a time and thread.
  template <class Compute>
  DirectIrradiance direct(std::size_t receiver, const Compute& compute) {
    if (size() == 0) return compute(nullptr);
    if (size() == 1) return direct_[receiver] = compute(nullptr);
    std::vector<DirectIrradiance> of_emitters(groups_->of_emitter.size());
    compute(&of_emitters);
    return keep(receiver, of_emitters);
  }
  // When all receivers have their direct light: completes it with that of the other ranks.
  const std::vector<DirectIrradiance>& all_direct(Communicator* communicator);

 private:
  DirectIrradiance keep(std::size_t receiver, const std::vector<DirectIrradiance>& of_emitters);

  std::optional<EmitterGroups> groups_;
  std::vector<DirectIrradiance> direct_;  // [receiver][part]
  bool complete_ = false;
};

// found: with sums of parts. direct: [receiver][part], in W/m² or lx.
EmitterParts estimate_parts(const Room& room, const EmitterGroups& groups, const OriginEstimates& found,
                            const std::vector<DirectIrradiance>& direct);

// The receivers with the parts multiplied by factors: standard errors with the covariances of the parts.
std::vector<ReceiverResult> receivers_by_parts(const EmitterParts& parts, const std::vector<Receiver>& receivers,
                                               const std::vector<double>& factors);

}  // namespace lichtmc

#include "output/channels_h5.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"
#include "output/channel_arrays.hpp"
#include "output/h5_writer.hpp"
#include "room/settings_fields.hpp"

namespace lichtmc {

namespace {

std::string without_slash(std::string group) {
  if (!group.empty() && group.back() == '/') group.pop_back();
  return group;
}

// A setting as an attribute: a number, or the text of setting_text().
template <class Value>
void write_setting(H5Writer& writer, const std::string& name, const Value& value) {
  if constexpr (std::same_as<Value, bool>) {
    writer.attribute("/settings", name, std::uint64_t{value ? 1U : 0U});
  } else if constexpr (std::same_as<Value, double>) {
    writer.attribute("/settings", name, value);
  } else if constexpr (std::unsigned_integral<Value>) {
    if (value == no_photon_limit)
      writer.attribute("/settings", name, setting_text(value));
    else
      writer.attribute("/settings", name, std::uint64_t{value});
  } else {
    writer.attribute("/settings", name, setting_text(value));
  }
}
template <class Value>
void write_setting(H5Writer& writer, const std::string& name, const std::optional<Value>& value) {
  if (value)
    write_setting(writer, name, *value);
  else
    writer.attribute("/settings", name, setting_text(value));
}

void write_facts(const Result& result, H5Writer& writer) {
  const ImpulseResponses& responses = *result.channels;
  writer.attribute("/", "title", "Impulse responses between the emitters and receivers of a room");
  writer.attribute("/", "program", "lichtmc");
  writer.attribute("/", "version", std::string(version()));
  writer.attribute("/", "room", result.room);
  writer.attribute("/", "seed", result.settings.seed);
  writer.attribute("/", "histories", result.receiver_walk.histories);
  writer.attribute("/", "rounds", result.receiver_walk.rounds);
  writer.attribute("/", "groups", responses.groups);
  writer.attribute("/", "power_unit", std::string(power_unit(result.quantity)));
  writer.attribute("/", "description", std::string(what_h_is));
  writer.attribute("/", "time_span_s", static_cast<double>(responses.bins) * responses.bin_width_s);
  writer.attribute("/", "time_span_was_chosen", std::uint64_t{responses.time_span_was_chosen ? 1U : 0U});
  if (!responses.frequencies_hz.empty())
    writer.attribute("/", "response_from_bins", std::uint64_t{responses.from_bins ? 1U : 0U});
  writer.make_group("settings");
  visit_fields(
      [&writer](const Field& field, const auto& value) {
        if (field.role != FieldRole::machine) write_setting(writer, field.name, value);
      },
      result.settings);
}

}  // namespace

void write_channels_h5(const Result& result, const Sink& sink) {
  const ImpulseResponses& responses = *result.channels;
  try {
    const std::vector<NamedArray> arrays = channel_arrays(result);
    std::uint64_t about = 0;
    for (const NamedArray& array : arrays) about += array.values().size_bytes();
    H5Writer writer(about);
    write_facts(result, writer);
    writer.names("emitter", "emitter", "names of the emitters; emitters of the same name share a channel",
                 responses.emitters);
    writer.names("receiver", "receiver", "names of the receivers", responses.receivers);
    writer.names("order", "order", "numbers of reflections; the last with a plus: this many and more",
                 order_names(responses));
    writer.make_group(without_slash(std::string(derived_group)));
    for (const NamedArray& array : arrays) writer.array(array);
    sink(writer.image());
  } catch (const Hdf5Error& error) {
    throw RuntimeError(std::string("Cannot write channels.h5 (") + error.what() +
                       "). There may be too little memory: use fewer bins, orders, emitters or receivers.");
  }
}

}  // namespace lichtmc

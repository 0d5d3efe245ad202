#include "output/channels_h5.hpp"

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <hdf5.h>

#include "base/hdf5.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"
#include "output/channel_arrays.hpp"
#include "room/settings_fields.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t chunk_values = std::size_t{1} << 16;  // 512 kB: fits into the cache, and compresses as one piece

std::string without_slash(std::string group) {
  if (!group.empty() && group.back() == '/') group.pop_back();
  return group;
}

class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::uint64_t about) : file_(make_hdf5_in_memory(0, about)) {}

  void make_group(const std::string& name) {
    const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "set up HDF5");
    check_hdf5(H5Pset_obj_track_times(creation, false), "set up HDF5");
    const Hdf5Handle group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose,
                           "make a group");
  }

  // Attributes of the group or data set `of`.
  void attribute(const std::string& of, const std::string& name, const std::string& text) {
    const char* const pointer = text.c_str();
    write_attribute(of, name, text_type(), &pointer);
  }
  void attribute(const std::string& of, const std::string& name, double value) {
    write_attribute(of, name, H5T_NATIVE_DOUBLE, &value);
  }
  void attribute(const std::string& of, const std::string& name, std::uint64_t value) {
    write_attribute(of, name, H5T_NATIVE_UINT64, &value);
  }

  void array(const ChannelArray& array) {
    const std::vector<hsize_t> sizes(array.sizes.begin(), array.sizes.end());
    const Hdf5Handle space = sizes.empty()
                                 ? Hdf5Handle(H5Screate(H5S_SCALAR), H5Sclose, "describe an array")
                                 : Hdf5Handle(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
                                              H5Sclose, "describe an array");
    const Hdf5Handle creation = creation_of(array);
    const Hdf5Handle made(
        H5Dcreate2(file_, array.name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
        "make an array");
    if (!array.values().empty())
      check_hdf5(H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values().data()),
                 "write an array");
    describe(array.name, array.unit, array.dimensions, array.description);
  }

  void names(const std::string& name, const std::string& dimension, const std::string& what,
             const std::vector<std::string>& texts) {
    const Hdf5Handle type = text_type();
    const hsize_t count = texts.size();
    const Hdf5Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, "describe an array");
    const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up HDF5");
    check_hdf5(H5Pset_obj_track_times(creation, false), "set up HDF5");
    const Hdf5Handle made(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose,
                          "make an array");
    std::vector<const char*> pointers;
    for (const std::string& text : texts) pointers.push_back(text.c_str());
    if (count > 0) check_hdf5(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()), "write an array");
    describe(name, "", dimension, what);
  }

  std::string_view image() const { return hdf5_image(file_, 0); }

 private:
  // Text of any length, which Python and MATLAB read as text and not as bytes.
  static Hdf5Handle text_type() {
    Hdf5Handle type = hdf5_text_type(0);
    check_hdf5(H5Tset_size(type, H5T_VARIABLE), "describe text");
    return type;
  }

  void write_attribute(const std::string& of, const std::string& name, hid_t type, const void* value) {
    const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, "describe an attribute");
    const Hdf5Handle attribute(
        H5Acreate_by_name(file_, of.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose, "make an attribute");
    check_hdf5(H5Awrite(attribute, type, value), "write an attribute");
  }

  void describe(const std::string& of, const std::string& unit, const std::string& dimensions,
                const std::string& description) {
    if (!unit.empty()) attribute(of, "unit", unit);
    attribute(of, "dimensions", dimensions);
    attribute(of, "description", description);
  }

  // Large arrays are compressed in chunks: of whole rows of the last dimensions, as many as fit.
  static Hdf5Handle creation_of(const ChannelArray& array) {
    Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "set up HDF5");
    check_hdf5(H5Pset_obj_track_times(creation, false), "set up HDF5");
    constexpr std::size_t few_values = 2048;  // less than four blocks of a disk: chunks would cost more than they save
    if (array.values().size() < few_values) return creation;
    std::vector<hsize_t> chunk(array.sizes.size());
    std::size_t left = chunk_values;
    for (std::size_t d = chunk.size(); d-- > 0;) {
      chunk[d] = std::min(array.sizes[d], std::max<std::size_t>(left, 1));
      left /= chunk[d];
    }
    check_hdf5(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()), "set up HDF5");
    // The bytes of doubles side by side: exponents compress, the last digits do not.
    check_hdf5(H5Pset_shuffle(creation), "set up HDF5");
    constexpr unsigned fast = 1;
    check_hdf5(H5Pset_deflate(creation, fast), "set up HDF5");
    return creation;
  }

  Hdf5Session session_;  // ends after the file is closed
  Hdf5Handle file_;
};

// A setting as an attribute: a number, or the text of setting_text().
template <class Value>
void write_setting(Hdf5Writer& writer, const std::string& name, const Value& value) {
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
void write_setting(Hdf5Writer& writer, const std::string& name, const std::optional<Value>& value) {
  if (value)
    write_setting(writer, name, *value);
  else
    writer.attribute("/settings", name, setting_text(value));
}

void write_facts(const Result& result, Hdf5Writer& writer) {
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
    const std::vector<ChannelArray> arrays = channel_arrays(result);
    std::uint64_t about = 0;
    for (const ChannelArray& array : arrays) about += array.values().size_bytes();
    Hdf5Writer writer(about);
    write_facts(result, writer);
    writer.names("emitter", "emitter", "names of the emitters; emitters of the same name share a channel",
                 responses.emitters);
    writer.names("receiver", "receiver", "names of the receivers", responses.receivers);
    writer.names("order", "order", "numbers of reflections; the last with a plus: this many and more",
                 order_names(responses));
    writer.make_group(without_slash(std::string(derived_group)));
    for (const ChannelArray& array : arrays) writer.array(array);
    sink(writer.image());
  } catch (const Hdf5Error& error) {
    throw RuntimeError(std::string("Cannot write channels.h5 (") + error.what() +
                       "). There may be too little memory: use fewer bins, orders, emitters or receivers.");
  }
}

}  // namespace lichtmc

#include "output/channels_mat.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/utf8.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/version.hpp"
#include "output/channel_arrays.hpp"

namespace lichtmc {

namespace {

// Of an array with its head, which takes some hundred bytes.
constexpr std::uint64_t max_array_bytes = (std::uint64_t{1} << 31) - 4096;

[[noreturn]] void fail(const std::string& reason) {
  throw RuntimeError("Cannot write channels.mat (" + reason +
                     "). There may be too little memory: use fewer bins, "
                     "orders, emitters or receivers.");
}

// A file in memory with a name: matio writes to named files only, and does not notice a full disk.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("channels.mat", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail(std::strerror(errno));
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  void copy_to(const Sink& sink) const {
    std::vector<char> buffer(std::size_t{1} << 20);
    for (off_t at = 0;;) {
      const ssize_t count = ::pread(descriptor_, buffer.data(), buffer.size(), at);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(std::strerror(errno));
      if (count == 0) return;
      sink({buffer.data(), static_cast<std::size_t>(count)});
      at += count;
    }
  }

 private:
  int descriptor_;
};

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

Variable made(matvar_t* variable) {
  if (variable == nullptr) fail("out of memory");
  return {variable, Mat_VarFree};
}

// Dimensions in MATLAB's order: at least two; numbers in a row become a column.
std::vector<std::size_t> reversed(const std::vector<std::size_t>& sizes) {
  std::vector<std::size_t> dimensions(sizes.rbegin(), sizes.rend());
  while (dimensions.size() < 2) dimensions.push_back(1);
  return dimensions;
}

// The values stay where they are: the array must outlive the variable.
Variable numbers(const std::string& name, std::vector<std::size_t> dimensions, std::span<const double> values) {
  return made(Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(dimensions.size()),
                            dimensions.data(), const_cast<double*>(values.data()), MAT_F_DONT_COPY_DATA));
}

// Text as UTF-16, which all versions of MATLAB read. Characters that take two units are replaced: scipy.io.loadmat
// refuses the whole file because of them.
std::vector<std::uint16_t> utf16_of(std::string_view text) {
  constexpr std::uint16_t replacement = 0xFFFD;
  std::vector<std::uint16_t> units;
  while (!text.empty()) {
    const Character character = first_character(text);
    const bool one_unit = character.bytes > 0 && character.code < 0x10000;
    units.push_back(one_unit ? static_cast<std::uint16_t>(character.code) : replacement);
    text.remove_prefix(std::max<std::size_t>(character.bytes, 1));
  }
  return units;
}

Variable text_variable(const char* name, std::string_view text) {
  std::vector<std::uint16_t> units = utf16_of(text);
  std::array<std::size_t, 2> dimensions{units.empty() ? 0U : 1U, units.size()};
  return made(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF16, 2, dimensions.data(), units.data(), 0));
}

// A column of texts as a cell array.
Variable cells(const char* name, const std::vector<std::string>& texts) {
  std::array<std::size_t, 2> dimensions{texts.size(), 1};
  Variable cell = made(Mat_VarCreate(name, MAT_C_CELL, MAT_T_CELL, 2, dimensions.data(), nullptr, 0));
  for (std::size_t k = 0; k < texts.size(); ++k)
    Mat_VarSetCell(cell.get(), static_cast<int>(k), text_variable(nullptr, texts[k]).release());
  return cell;
}

// The derived figures as fields of a struct.
Variable derived_struct(const std::vector<NamedArray>& arrays) {
  std::vector<const NamedArray*> fields;
  std::vector<std::string> names;
  std::vector<const char*> pointers;
  for (const NamedArray& array : arrays) {
    if (!array.name.starts_with(derived_group)) continue;
    fields.push_back(&array);
    names.push_back(array.name.substr(derived_group.size()));
  }
  for (const std::string& name : names) pointers.push_back(name.c_str());
  std::array<std::size_t, 2> dimensions{1, 1};
  Variable group = made(
      Mat_VarCreateStruct("derived", 2, dimensions.data(), pointers.data(), static_cast<unsigned>(pointers.size())));
  for (std::size_t k = 0; k < fields.size(); ++k)
    Mat_VarSetStructFieldByName(group.get(), pointers[k], 0,
                                numbers(names[k], reversed(fields[k]->sizes), fields[k]->values()).release());
  return group;
}

class MatWriter {
 public:
  explicit MatWriter(const std::string& file) {
    const std::string head = "MATLAB 5.0 MAT-file, written by lichtmc " + std::string(version());
    mat_.reset(Mat_CreateVer(file.c_str(), head.c_str(), MAT_FT_MAT5));
    if (!mat_) fail("the file cannot be made");
  }
  // Without compression: the last digits of noise do not compress, and would take longer than the rest.
  void write(const Variable& variable) {
    if (Mat_VarWrite(mat_.get(), variable.get(), MAT_COMPRESSION_NONE) != 0)
      fail("variable " + std::string(variable->name) + " cannot be written");
  }
  void close() {
    if (Mat_Close(mat_.release()) != 0) fail("the file cannot be finished");
  }

 private:
  struct Close {
    void operator()(mat_t* mat) const { Mat_Close(mat); }
  };
  std::unique_ptr<mat_t, Close> mat_;
};

// The channel models of IEEE 802.11bb are single channels in bins of 1 ns.
bool is_like_channel_models(const ImpulseResponses& responses) {
  constexpr double nanosecond = 1e-9;
  constexpr double rounding = 1e-12;  // of a width given as a length or in other units
  return responses.channels.size() == 1 && std::abs(responses.bin_width_s / nanosecond - 1.0) < rounding;
}

void write_averun(const ImpulseResponses& responses, MatWriter& writer) {
  std::vector<double> number;
  std::vector<double> gain;
  for (const double h : responses.h_all) {
    number.push_back(static_cast<double>(number.size() + 1));
    gain.push_back(h * responses.bin_width_s);
  }
  writer.write(numbers("averun1", {number.size(), 1}, number));
  writer.write(numbers("averun2", {gain.size(), 1}, gain));
}

}  // namespace

std::string obstacle_to_channels_mat(const Result& result) {
  const ImpulseResponses& responses = *result.channels;
  const std::uint64_t bytes =
      std::uint64_t{sizeof(double)} * responses.channels.size() * responses.columns() * responses.bins;
  if (bytes < max_array_bytes) return {};
  return "channels.mat is not written, because h has " + std::to_string(bytes >> 20U) +
         " MiB (limit of MATLAB's level 5 format: 2047 MiB per array). Use channels.h5, which MATLAB's h5read reads, "
         "or "
         "fewer bins, orders, emitters or receivers.";
}

void write_channels_mat(const Result& result, const Sink& sink) {
  const ImpulseResponses& responses = *result.channels;
  const MemoryFile file;
  MatWriter writer(file.name());
  const std::vector<NamedArray> arrays = channel_arrays(result);
  for (const NamedArray& array : arrays) {
    if (!array.name.starts_with(derived_group))
      writer.write(numbers(array.name, reversed(array.sizes), array.values()));
  }
  writer.write(derived_struct(arrays));
  writer.write(cells("emitter", responses.emitters));
  writer.write(cells("receiver", responses.receivers));
  writer.write(cells("order", order_names(responses)));
  writer.write(text_variable("description", what_h_is));
  writer.write(text_variable("room", result.room));
  if (is_like_channel_models(responses)) write_averun(responses, writer);
  writer.close();
  file.copy_to(sink);
}

}  // namespace lichtmc

// Archives in memory for the serialization library cereal: bytes out, bytes in.
//
// cereal's own archives work on streams, and take the memory for a list before they know whether its elements follow.
// Here a list has at most as many elements as bytes are left, and gets memory in proportion to these bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ios>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <cereal/cereal.hpp>

namespace lichtmc::python {

class BytesOut : public cereal::OutputArchive<BytesOut, cereal::AllowEmptyClassElision> {
 public:
  BytesOut() : OutputArchive(this) {}
  void saveBinary(const void* data, std::streamsize size) {
    bytes.append(static_cast<const char*>(data), static_cast<std::size_t>(size));
  }
  std::string bytes;
};

class BytesIn : public cereal::InputArchive<BytesIn, cereal::AllowEmptyClassElision> {
 public:
  // The bytes must outlive the archive.
  explicit BytesIn(std::string_view bytes) : InputArchive(this), left_(bytes) {}
  void loadBinary(void* data, std::streamsize size) {
    const auto count = static_cast<std::size_t>(size);
    require(count);
    std::memcpy(data, left_.data(), count);
    left_.remove_prefix(count);
  }
  // Throws cereal::Exception if fewer bytes are left.
  void require(std::uint64_t count) const {
    if (count > left_.size()) throw cereal::Exception("they end too early");
  }
  std::size_t left() const { return left_.size(); }
  bool at_end() const { return left_.empty(); }

 private:
  std::string_view left_;
};

template <class Number>
requires std::is_arithmetic_v<Number>
void CEREAL_SAVE_FUNCTION_NAME(BytesOut& archive, const Number& value) {
  archive.saveBinary(std::addressof(value), sizeof value);
}
template <class Number>
requires std::is_arithmetic_v<Number>
void CEREAL_LOAD_FUNCTION_NAME(BytesIn& archive, Number& value) {
  archive.loadBinary(std::addressof(value), sizeof value);
}

template <class Size>
void CEREAL_SAVE_FUNCTION_NAME(BytesOut& archive, const cereal::SizeTag<Size>& tag) {
  archive(tag.size);
}
template <class Size>
void CEREAL_LOAD_FUNCTION_NAME(BytesIn& archive, cereal::SizeTag<Size>& tag) {
  archive(tag.size);
  archive.require(tag.size);
}

template <class Value>
void CEREAL_SERIALIZE_FUNCTION_NAME(BytesOut& archive, cereal::NameValuePair<Value>& named) {
  archive(named.value);
}
template <class Value>
void CEREAL_SERIALIZE_FUNCTION_NAME(BytesIn& archive, cereal::NameValuePair<Value>& named) {
  archive(named.value);
}

template <class Data>
void CEREAL_SAVE_FUNCTION_NAME(BytesOut& archive, const cereal::BinaryData<Data>& data) {
  archive.saveBinary(data.data, static_cast<std::streamsize>(data.size));
}
template <class Data>
void CEREAL_LOAD_FUNCTION_NAME(BytesIn& archive, cereal::BinaryData<Data>& data) {
  archive.loadBinary(data.data, static_cast<std::streamsize>(data.size));
}

template <class Value, class Allocator>
requires(!std::is_same_v<Value, bool>) void CEREAL_LOAD_FUNCTION_NAME(BytesIn& archive,
                                                                      std::vector<Value, Allocator>& list) {
  cereal::size_type size = 0;
  archive(cereal::make_size_tag(size));
  list.clear();
  if constexpr (std::is_arithmetic_v<Value>) {
    if (size > archive.left() / sizeof(Value)) throw cereal::Exception("they end too early");
    list.resize(size);
    archive(cereal::binary_data(list.data(), size * sizeof(Value)));
  } else {
    // Elements need at least a quarter of their memory as bytes, or the list grows again while they are read.
    list.reserve(std::min<std::size_t>(size, 4 * archive.left() / sizeof(Value)));
    for (cereal::size_type k = 0; k < size; ++k) archive(list.emplace_back());
  }
}

}  // namespace lichtmc::python

CEREAL_SETUP_ARCHIVE_TRAITS(lichtmc::python::BytesIn, lichtmc::python::BytesOut)

#include "gltf/document.hpp"

#include <cmath>

#include "base/message.hpp"
#include "base/wide.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

std::string label(const char* kind, const std::string& name, std::size_t index) {
  return std::string(kind) + " " + (name.empty() ? std::to_string(index) : in_quotes(name));
}

void refuse(const Document& document, const std::string& what_and_remedy) {
  throw InputError(document.file + ": " + what_and_remedy);
}

std::size_t checked_index(const Document& document, long long index, std::size_t count, const std::string& what) {
  if (index >= 0 && static_cast<unsigned long long>(index) < count) return static_cast<std::size_t>(index);
  refuse(document,
         what + " is number " + std::to_string(index) +
             (count == 0 ? ", but the file has none of them." : " (allowed: 0 to " + std::to_string(count - 1) + ").") +
             export_again);
}

std::string_view bytes_of_view(const Document& document, long long index, const std::string& what) {
  const auto& model = document.model;
  const auto& view =
      model.bufferViews[checked_index(document, index, model.bufferViews.size(), "the buffer view of " + what)];
  const auto& bytes =
      model.buffers[checked_index(document, view.buffer, model.buffers.size(), "the buffer of " + what)].data;
  if (static_cast<uint128>(view.byteOffset) + view.byteLength > bytes.size())
    refuse(document, what + " reaches beyond its buffer." + export_again);
  return {reinterpret_cast<const char*>(bytes.data()) + view.byteOffset, view.byteLength};
}

double number_in(const Document& document, const tinygltf::Value& object, const char* name, double otherwise,
                 const std::string& where) {
  if (!object.IsObject() || !object.Has(name)) return otherwise;
  const tinygltf::Value& value = object.Get(name);
  if (!value.IsNumber())
    refuse(document, "'" + std::string(name) + "' of " + where + " is not a number. Set it to a number.");
  return value.GetNumberAsDouble();
}

glm::dvec3 colour_in(const Document& document, const tinygltf::Value& object, const char* name,
                     const glm::dvec3& otherwise, const std::string& where) {
  if (!object.IsObject() || !object.Has(name)) return otherwise;
  const tinygltf::Value& value = object.Get(name);
  glm::dvec3 colour(0.0);
  bool valid = value.IsArray() && value.ArrayLen() >= 3;
  for (int k = 0; valid && k < 3; ++k) {
    // Value::Get(index) takes other types in other releases of the parser.
    const tinygltf::Value& channel = value.Get<tinygltf::Value::Array>()[static_cast<std::size_t>(k)];
    valid = channel.IsNumber() && channel.GetNumberAsDouble() >= 0.0 && std::isfinite(channel.GetNumberAsDouble());
    if (valid) colour[k] = channel.GetNumberAsDouble();
  }
  if (!valid) {
    refuse(document,
           "'" + std::string(name) + "' of " + where +
               " is not a colour (allowed: at least three finite numbers, 0 or more). Export the file again.");
  }
  return colour;
}

}  // namespace lichtmc

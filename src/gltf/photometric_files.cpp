#include "gltf/photometric_files.hpp"

#include <cmath>
#include <utility>

#include "base/base64.hpp"
#include "base/message.hpp"
#include "base/read_file.hpp"
#include "gltf/external_files.hpp"
#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

constexpr const char* photometric_type = "application/x-ies-lm-63";
constexpr std::uint64_t most_photometric_bytes = std::uint64_t{1} << 24;

const tinygltf::Value::Array& lights_of_file(const Document& document) {
  static const tinygltf::Value::Array none;
  const auto found = document.model.extensions.find("EXT_lights_ies");
  if (found == document.model.extensions.end() || !found->second.IsObject() || !found->second.Has("lights"))
    return none;
  const tinygltf::Value& lights = found->second.Get("lights");
  return lights.IsArray() ? lights.Get<tinygltf::Value::Array>() : none;
}

std::string text_of(const tinygltf::Value& object, const char* name) {
  return object.IsObject() && object.Has(name) && object.Get(name).IsString() ? object.Get(name).Get<std::string>()
                                                                              : "";
}

// The bytes of a data URI (RFC 2397); none if they are not in base64.
std::optional<std::string> bytes_of_data_uri(const std::string& uri) {
  const std::size_t comma = uri.find(',');
  const std::string marker = ";base64";
  if (comma == std::string::npos || comma < marker.size() ||
      uri.compare(comma - marker.size(), marker.size(), marker) != 0)
    return std::nullopt;
  return base64_decoded(std::string_view(uri).substr(comma + 1));
}

std::string name_in_path(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

PhotometricFiles::Content PhotometricFiles::content_of_file(const std::string& name, bool is_uri,
                                                            const std::string& what) const {
  const ContainedPath place = is_uri ? locate_uri(*document_, name) : locate_name(*document_, name);
  if (!place.fault.empty())
    refuse(*document_, what + " is not opened: " + place.fault + " (allowed: " + place.allowed + "). " + place.remedy);
  FileContent content = read_regular_file(place.path, most_photometric_bytes);
  if (content.missing) refuse(*document_, what + " is missing. Copy it into the folder of the room file.");
  if (!content.fault.empty())
    refuse(*document_, what + " cannot be read (" + content.fault +
                           "; allowed: a regular file). Copy it into the folder of the room file.");
  return {std::move(content.bytes), place.path.string(), place.path.parent_path()};
}

PhotometricFiles::Content PhotometricFiles::content_of_view(const tinygltf::Value& light, const std::string& which,
                                                            const std::string& start) const {
  const std::string type = text_of(light, "mimeType");
  if (type != photometric_type) {
    refuse(*document_, start + which + " has a bufferView " +
                           (type.empty() ? std::string("without mimeType") : "with the mimeType " + in_quotes(type)) +
                           " (allowed: " + photometric_type + "). Export the file again.");
  }
  const double number = number_in(*document_, light, "bufferView", -1.0, which);
  const long long index = number >= 0.0 && number < 1e9 && number == std::floor(number) ? std::llround(number) : -1;
  const std::string_view bytes = bytes_of_view(*document_, index, "the file of " + which);
  return {std::string(bytes), "", std::nullopt};
}

PhotometricFiles::Content PhotometricFiles::content_of_light(const tinygltf::Value& light, const std::string& which,
                                                             const std::string& start) const {
  const bool has_uri = light.IsObject() && light.Has("uri");
  const bool has_view = light.IsObject() && light.Has("bufferView");
  if (has_uri == has_view) {
    refuse(*document_, start + which + (has_uri ? " has both uri and bufferView" : " has neither uri nor bufferView") +
                           " (allowed: one of them, with the photometric file). Export the file again.");
  }
  if (has_view) return content_of_view(light, which, start);
  const std::string uri = text_of(light, "uri");
  if (uri.compare(0, 5, "data:") != 0)
    return content_of_file(uri, true, start + "the photometric file " + in_quotes(uri) + " of " + which);
  auto bytes = bytes_of_data_uri(uri);
  if (!bytes)
    refuse(*document_, start + "the data URI of " + which + " is damaged (allowed: data:" + photometric_type +
                           ";base64, and the file in base64). Export the file again.");
  return {std::move(*bytes), "", std::nullopt};
}

PhotometricFiles::Shared PhotometricFiles::of_light(double number, const PhotometryOptions& options,
                                                    const std::string& where, std::vector<Ignored>& ignored) {
  const tinygltf::Value::Array& lights = lights_of_file(*document_);
  if (!(number >= 0.0 && number < static_cast<double>(lights.size())) || number != std::floor(number)) {
    refuse(*document_, where + ": EXT_lights_ies light " + to_text(number) + ", but there " +
                           (lights.size() == 1 ? "is " : "are ") + to_text(lights.size(), "profile") +
                           " (allowed: the number of a profile, from 0). Export the file again.");
  }
  const tinygltf::Value& light = lights[static_cast<std::size_t>(number)];
  const std::string uri = text_of(light, "uri");
  const bool external = !uri.empty() && uri.compare(0, 5, "data:") != 0;
  const Key key{(external ? "uri " + uri : "light " + to_text(number)), options.lamp_set, options.flip_horizontal,
                options.needs_flux};
  if (const auto found = files_.find(key); found != files_.end()) return found->second;
  const std::string which = "EXT_lights_ies light " + to_text(number);
  Content content = content_of_light(light, which, where + ": ");
  const std::string own_name = text_of(light, "name");
  if (!external) content.source = document_->file + ", " + which;
  // Embedded files are known by the name of the light.
  const std::string known_as = external ? "" : own_name.empty() ? which : own_name;
  const Shared photometry = parsed(content, key, known_as, options);
  tell(*photometry, true, ignored);
  return photometry;
}

PhotometricFiles::Shared PhotometricFiles::of_name(const std::string& name, const PhotometryOptions& options,
                                                   const std::string& where, std::vector<Ignored>& ignored) {
  const Key key{"name " + name, options.lamp_set, options.flip_horizontal, options.needs_flux};
  if (const auto found = files_.find(key); found != files_.end()) return found->second;
  const Content content =
      content_of_file(name, false, "the photometric file " + in_quotes(name) + " in 'ies' of " + where);
  const Shared photometry = parsed(content, key, "", options);
  tell(*photometry, false, ignored);
  return photometry;
}

PhotometricFiles::Shared PhotometricFiles::parsed(const Content& content, const Key& key, const std::string& own_name,
                                                  const PhotometryOptions& options) {
  auto photometry =
      std::make_shared<Photometry>(parse_photometry(content.bytes, content.source, options, content.folder));
  if (!own_name.empty()) photometry->source = own_name;
  files_[key] = photometry;
  return photometry;
}

void PhotometricFiles::tell(const Photometry& photometry, bool of_extension, std::vector<Ignored>& ignored) {
  std::vector<Ignored> remarks = remarks_of(photometry);
  if (of_extension && photometry.format == PhotometryFormat::eulumdat) {
    remarks.push_back(
        {"Photometric file " + in_quotes(name_in_path(photometry.source)) +
             " is a EULUMDAT file: EXT_lights_ies defines IES LM-63 files only, and other programs may not "
             "read it.",
         Effect::none});
  }
  for (Ignored& remark : remarks) {
    if (told_.insert(remark.what).second) ignored.push_back(std::move(remark));
  }
}

}  // namespace lichtmc

#include "output/report_pictures.hpp"

#include <cstddef>

#include "base/base64.hpp"
#include "base/message.hpp"
#include "lichtmc/units.hpp"
#include "output/assets.hpp"
#include "output/html.hpp"

namespace lichtmc {

namespace {

constexpr std::size_t max_embedded_bytes = std::size_t{24} << 20;  // of room_lit.glb

bool embeds_room(const ReportContent& content) {
  return !content.lit_room.empty() && content.lit_room.size() <= max_embedded_bytes;
}

}  // namespace

std::string pictures_section(const ReportContent& content) {
  if (content.room_picture.empty()) return {};
  std::string html = heading("The room") + element("figure", content.room_picture, " id=\"picture-room\"") +
                     element("figure", content.above_picture, " id=\"picture-above\"");
  if (!content.paths_picture.empty()) html += element("figure", content.paths_picture, " id=\"picture-paths\"");
  return html;
}

std::string view_section(const ReportContent& content) {
  if (content.lit_room.empty()) return {};
  if (!embeds_room(content)) {
    return heading("3-D view") +
           text_element("p", "The file room_lit.glb, in the folder of this page, has " +
                                 short_number(static_cast<double>(content.lit_room.size()) / 1e6) +
                                 " MB (limit for this page: 25 MB). Open it in a glTF viewer.");
  }
  return element(
      "section",
      heading("3-D view") +
          text_element(
              "p",
              "Drag to rotate, use the wheel or pinch to zoom, shift and drag to pan. Point at a surface to read its " +
                  std::string(irradiance_word(content.result->quantity)) +
                  ". The file room_lit.glb contains the same room for any glTF viewer.",
              " class=\"muted\"") +
          element("div", "", " id=\"view3d\" tabindex=\"0\""),
      " class=\"screen-only\"");
}

std::string scripts_of_page(const ReportContent& content) {
  std::string html = element("script", report_js);
  if (!embeds_room(content)) return html;
  html += element("script", base64(content.lit_room), " type=\"application/octet-stream\" id=\"room-lit\"");
  html += element("script", viewer_js);
  // Starts after the page has loaded, so that it does not delay the text.
  return html + element("script", R"(
addEventListener("load", () => {
  const bytes = Uint8Array.from(atob(document.getElementById("room-lit").textContent), c => c.charCodeAt(0));
  lichtmcView(document.getElementById("view3d"), bytes.buffer);
});
)");
}

}  // namespace lichtmc

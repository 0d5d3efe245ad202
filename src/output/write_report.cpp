// Writes the report: pictures, room_lit.glb and report.html.
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/parallel.hpp"
#include "lichtmc/area_drawing.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/lit_room.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/paths.hpp"
#include "output/area_plan.hpp"
#include "output/channel_pictures.hpp"
#include "output/folder.hpp"
#include "output/lit_side_words.hpp"
#include "output/luminaire_schedule.hpp"
#include "output/picture_svg.hpp"
#include "output/report.hpp"
#include "output/tables.hpp"
#include "output/tile_image.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t picture_width = 1200;  // pixels: sufficient for the page, and for 18 cm in print
constexpr std::size_t picture_height = 820;
constexpr std::uint64_t max_paths = 10'000;

class ReportWriter {
 public:
  ReportWriter(const Room& room, const Result& result, const fs::path& folder, const ReportOptions& options)
      : room_(&room), result_(&result), folder_(folder), options_(&options) {
    content_.room = &room;
    content_.result = &result;
    content_.command = options.command;
    content_.tile_images = options.tile_images;
    content_.style = options.style != ReportStyle::automatic ? options.style
                     : result.areas.empty()                  ? ReportStyle::technical
                                                             : ReportStyle::lighting;
    content_.project = options.project;
    content_.author = options.author;
    content_.date = options.date;
  }

  void write() {
    draw_luminaires();
    if (result_->channels) draw_channels();
    if (!result_->tiles.empty() || !result_->receiver_results.empty()) {
      content_.scale = choose_scale(*result_, options_->scale);
      draw();
    }
    if (options_->inspection != nullptr) {
      content_.inspection = *options_->inspection;
    } else {
      announce("Checking the room");
      content_.inspection = inspect(*room_, result_->tiling, result_->settings.tile_edge_m, options_->prepared);
    }
    announce("Writing report.html");
    folder_.write("report.html", report_html(content_));
    folder_.publish("report.html");
  }

 private:
  void announce(std::string_view step) const {
    if (options_->progress) options_->progress(step);
  }

  // A picture with its PNG file, encoded once.
  struct Drawn {
    std::string name;
    const Picture* picture = nullptr;
    std::string png;
    std::string svg;
  };

  void write_picture(const std::string& stem, const Drawn& drawn) {
    const fs::path pictures = "pictures";
    folder_.write(pictures / (stem + ".png"), drawn.png);
    folder_.write(pictures / (stem + ".svg"), drawn.svg);
    if (options_->exr_pictures) folder_.write(pictures / (stem + ".exr"), exr_of(*drawn.picture, *result_));
  }

  Drawn room_picture(const std::string& name, const Picture& picture, View view) const {
    Drawn drawn{name, &picture, png_of(picture), {}};
    drawn.svg = room_svg(*room_, *result_, picture, drawn.png, content_.scale, view);
    return drawn;
  }

  Drawn plan_picture(const std::string& name, const SurfacePlan& plan) const {
    Drawn drawn{name, &plan.picture, png_of(plan.picture), {}};
    drawn.svg = plan_svg(*result_, plan, drawn.png, content_.scale, name);
    return drawn;
  }

  void draw() {
    announce("Drawing the room");
    const RoomPainter painter(*room_, *result_, options_->threads, options_->prepared);
    const Picture room = painter.draw(View::corner, content_.scale, picture_width, picture_height);
    const Picture above = painter.draw(View::above, content_.scale, picture_width, picture_height);
    std::vector<std::string> names;
    if (!result_->tiles.empty()) names = draw_surfaces(painter);
    for (std::size_t k = 0; k < result_->areas.size(); ++k)
      content_.area_plans.push_back(
          area_plan_svg(*room_, *result_, k, choose_area_scale(*result_, k, options_->scale)));
    // The pictures of the room come first: a surface with the name "room" then gets another file name. Encoding takes
    // longer than drawing.
    std::vector<Drawn> all(2 + names.size());
    for_each_on_threads(options_->threads > 0 ? options_->threads : usable_processors(), all.size(),
                        [&](std::size_t k) {
                          all[k] = k == 0   ? room_picture("room", room, View::corner)
                                   : k == 1 ? room_picture("above", above, View::above)
                                            : plan_picture(names[k - 2], content_.plans[k - 2]);
                        });
    content_.room_picture = all[0].svg;
    content_.above_picture = all[1].svg;
    for (std::size_t k = 2; k < all.size(); ++k) content_.plan_pictures.push_back(all[k].svg);
    const std::vector<PhotonPath> paths = trace();
    announce("Writing pictures");
    write_pictures(all);
    if (result_->tiles.empty()) return;
    content_.lit_room = lit_room_glb(*room_, *result_, painter.lit_sides(), content_.scale, paths);
    folder_.write("room_lit.glb", content_.lit_room);
  }

  // Plans of the surfaces; returns their names.
  std::vector<std::string> draw_surfaces(const RoomPainter& painter) {
    announce("Drawing plans of the surfaces");
    content_.lit_sides = lit_side_words(*room_, *result_, painter.lit_sides());
    SurfacePlans plans = draw_plans(*room_, *result_, painter.lit_sides(), content_.scale);
    content_.plans = std::move(plans.plans);
    content_.without_plan = std::move(plans.left_out);
    return plan_names(*result_, content_.plans);
  }

  // Surfaces do not get the names of other pictures.
  void write_pictures(const std::vector<Drawn>& all) {
    std::vector<std::string> stems{"paths"};
    stems.insert(stems.end(), taken_files_.begin(), taken_files_.end());
    const std::size_t first = stems.size();
    for (const Drawn& drawn : all) stems.push_back(drawn.name);
    stems = file_stems(stems);
    if (!content_.paths_picture.empty())
      folder_.write(fs::path("pictures") / (stems[0] + ".svg"), content_.paths_picture);
    for (std::size_t k = 0; k < all.size(); ++k) write_picture(stems[first + k], all[k]);
  }

  // The picture of each photometric file.
  void draw_luminaires() {
    const std::vector<ScheduleRow> rows = luminaire_schedule(*room_);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k > 0 && rows[k].file == rows[k - 1].file) continue;
      const std::string name = "luminaire_" + std::to_string(rows[k].file + 1);
      taken_files_.push_back(name);
      folder_.write(fs::path("pictures") / (name + ".svg"), luminaire_svg(*rows[k].photometry));
    }
  }

  // Pictures of the strongest and the weakest channel.
  void draw_channels() {
    announce("Drawing impulse responses");
    const fs::path pictures = "pictures";
    for (const std::size_t pair : shown_channels(*result_->channels)) {
      const std::string suffix = content_.channels.empty() ? "" : "_lowest_gain";
      content_.channels.push_back(channel_pictures(*result_, pair));
      const ChannelPictures& drawn = content_.channels.back();
      const auto write = [&](const std::string& name, const std::string& picture) {
        if (picture.empty()) return;
        taken_files_.push_back(name + suffix);
        folder_.write(pictures / (name + suffix + ".svg"), picture);
      };
      write("impulse_response", drawn.response);
      write("impulse_response_orders", drawn.by_order);
      write("frequency_response", drawn.frequency);
    }
  }

  // The paths of the first photons of the run, if requested.
  std::vector<PhotonPath> trace() {
    if (options_->paths == 0) return {};
    Settings settings = result_->settings;
    settings.estimator = result_->walk.estimator;
    std::vector<PhotonPath> paths = trace_paths(*room_, settings, options_->paths);
    content_.paths_picture = paths_svg(*room_, paths);
    return paths;
  }

  const Room* room_;
  const Result* result_;
  StagedFiles folder_;
  const ReportOptions* options_;
  ReportContent content_;
  std::vector<std::string> taken_files_;  // names of pictures of luminaires and channels, without .svg
};

}  // namespace

// A picture of lichtmc is recognised by the first line of its SVG; other files belong to the user.
void remove_report(const fs::path& folder) {
  remove_old(folder / "report.html");
  remove_old(folder / "room_lit.glb");
  remove_old_files(folder / "pictures", [](const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension != ".svg" && extension != ".png" && extension != ".exr") return false;
    std::ifstream svg(fs::path(file).replace_extension(".svg"));
    std::string line;
    return std::getline(svg, line) && line.find(" class=\"lichtmc\"") != std::string::npos;
  });
}

void write_paths(const Room& room, const std::vector<PhotonPath>& paths, const fs::path& folder) {
  write_file_atomically(folder / "paths.csv", paths_csv(room, paths));
  write_file_atomically(folder / "paths.svg", paths_svg(room, paths));
  write_file_atomically(folder / "paths.glb", paths_glb(paths));
}

void write_report(const Room& room, const Result& result, const fs::path& folder, const ReportOptions& options) {
  if (options.paths > max_paths)
    throw InputError("The number of photon paths is " + std::to_string(options.paths) +
                     " (allowed: 0 to 10000). Give --paths a smaller number.");
  remove_report(folder);
  ReportWriter(room, result, folder, options).write();
}

}  // namespace lichtmc

#include "output/write_areas.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <system_error>

#include "lichtmc/area_drawing.hpp"
#include "output/area_dxf.hpp"
#include "output/area_plan.hpp"
#include "output/area_tables.hpp"
#include "output/tile_image.hpp"

namespace lichtmc {

namespace fs = std::filesystem;

std::vector<std::string> area_file_stems(const Result& result) {
  std::vector<std::string> names;
  for (const AreaResult& one : result.areas) names.push_back(one.area.properties.name);
  return file_stems(names);
}

void write_areas(const Room& room, const Result& result, StagedFiles& staged) {
  if (result.areas.empty()) return;
  const std::vector<std::string> stems = area_file_stems(result);
  for (std::size_t k = 0; k < result.areas.size(); ++k) {
    const fs::path stem = fs::path("areas") / stems[k];
    const AreaDrawing drawing = draw_area(room, result, k);
    staged.write(stem.string() + ".csv", area_grid_csv(result, k, drawing));
    staged.write(stem.string() + ".svg", area_plan_svg(result, k, drawing, choose_area_scale(result, k)));
    staged.write(stem.string() + ".dxf", area_dxf(result, k, drawing));
  }
  staged.write("areas.csv", areas_csv(result));
}

void remove_old_areas(const Result& result, const fs::path& folder) {
  const std::vector<std::string> stems = area_file_stems(result);
  const std::set<std::string> kept(stems.begin(), stems.end());
  remove_old_files(folder / "areas", [&kept](const fs::path& file) {
    const std::string ending = file.extension().string();
    const bool ours = std::find(area_file_endings.begin(), area_file_endings.end(), ending) != area_file_endings.end();
    return ours && !kept.contains(file.stem().string());
  });
  if (!result.areas.empty()) return;
  std::error_code not_empty;
  fs::remove(folder / "areas", not_empty);
  remove_old(folder / "areas.csv");
}

}  // namespace lichtmc

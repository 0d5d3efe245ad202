// lichtmc_bench: the speed of the engine, as ratios of alternating measurements, each with its limit.
#include <algorithm>
#include <cstdio>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "lichtmc/simulate.hpp"
#include "lichtmc/version.hpp"
#include "luminaire_rows.hpp"
#include "measure.hpp"
#include "raw_embree.hpp"
#include "receiver_rows.hpp"
#include "rooms.hpp"
#include "row.hpp"
#include "support/textbook_walk.hpp"

namespace lichtmc::bench {

namespace {

Settings settings_for(Estimator estimator, Engine engine) {
  Settings settings;
  settings.estimator = estimator;
  settings.engine = engine;
  settings.threads = 1;
  return settings;
}

Work walking(Stage& stage, double impacts) {
  return [&stage, impacts] { return stage.walk(impacts); };
}

Measured against_textbook(const Options& options, double reflectance, double bar) {
  Stage stage(paper_cube(reflectance), settings_for(Estimator::collision, Engine::cuboid), 0.1);
  std::uint64_t seed = 1;
  const Work textbook = [&] {
    test::TextbookRoom room;
    room.reflectance = reflectance;
    std::uint64_t impacts = 0;
    test::textbook_walk(room, static_cast<std::uint64_t>(options.impacts() * (1.0 - reflectance)), seed++, impacts);
    return static_cast<double>(impacts);
  };
  const Ratio ratio = compare_speeds(walking(stage, options.impacts()), textbook, options.turns());
  char what[96];
  std::snprintf(what, sizeof what, "cuboid tracer against a textbook loop, rho %.1f, collision, 600 tiles",
                reflectance);
  return {what, ratio.value, bar, true, "", details_of(ratio, "impacts_per_second", "textbook_impacts_per_second")};
}

Measured against_raw_embree(const Options& options, std::size_t triangles) {
  Stage stage(room_of_triangles(triangles), settings_for(Estimator::collision, Engine::embree), 0.1);
  const std::size_t flights = options.quick ? 200'000 : 1'000'000;
  RawEmbree raw(stage, flights);
  double fastest = 0.0;
  int best = 1;
  nlohmann::ordered_json rates;
  for (const int packet : {1, 8, 16}) {
    std::vector<double> speeds;
    for (int turn = 0; turn < 3; ++turn) {
      double done = 0.0;
      const double seconds = seconds_of([&] { done = raw.trace(packet); });
      speeds.push_back(done / seconds);
    }
    const double speed = median(speeds);
    rates["packets of " + std::to_string(packet)] = speed;
    if (speed > fastest) {
      fastest = speed;
      best = packet;
    }
  }
  const Ratio ratio = compare_speeds(
      walking(stage, static_cast<double>(flights)), [&] { return raw.trace(best); }, options.turns());
  Measured measured{"Embree: walk against raw queries, " + std::to_string(triangles) + " triangles",
                    ratio.value,
                    triangles > 100'000 ? 0.8 : 0.75,
                    true,
                    "",
                    details_of(ratio, "impacts_per_second", "raw_rays_per_second")};
  measured.details["raw"] = rates;
  return measured;
}

Measured two_threads(const Options& options) {
  const auto speed = [&](unsigned threads) -> Work {
    return [&options, threads] {
      Settings settings = settings_for(Estimator::collision, Engine::automatic);
      settings.threads = threads;
      // Long enough that the start of threads is negligible.
      settings.photons = static_cast<std::uint64_t>(5.0 * options.impacts());
      return static_cast<double>(simulate(paper_cube(0.6), settings).walk.impacts);
    };
  };
  const Ratio ratio = compare_speeds(speed(2), speed(1), options.turns());
  return {"two threads against one", ratio.value, 1.85, true, "", details_of(ratio, "two", "one")};
}

Measured many_tiles(const Options& options) {
  const Settings settings = settings_for(Estimator::collision, Engine::cuboid);
  Stage many(paper_cube(0.6), settings, 1.0 / 129.0);
  Stage few(paper_cube(0.6), settings, 0.1);
  const Ratio ratio =
      compare_speeds(walking(many, options.impacts()), walking(few, options.impacts()), options.turns());
  return {std::to_string(many.tiles()) + " tiles against " + std::to_string(few.tiles()),
          ratio.value,
          0.85,
          true,
          "",
          details_of(ratio, "many", "few")};
}

Measured estimator(const Options& options, Estimator which) {
  Stage one(paper_cube(0.6), settings_for(which, Engine::cuboid), 0.1);
  Stage collision(paper_cube(0.6), settings_for(Estimator::collision, Engine::cuboid), 0.1);
  const Ratio ratio =
      compare_speeds(walking(one, options.impacts()), walking(collision, options.impacts()), options.turns());
  return {std::string(to_string(which)) + " against collision, impacts per second",
          ratio.value,
          0.8,
          true,
          "",
          details_of(ratio, "estimator", "collision")};
}

// The cost of an unused feature of a room, against the same room without it.
Measured unused(const Options& options, const std::string& what, const std::function<void(Room&)>& add) {
  const Settings settings = settings_for(Estimator::collision, Engine::cuboid);
  // Many short turns resolve a difference of 1 % on a machine with other load. The speed also depends on the position
  // of a room in memory: so several pairs of rooms are measured.
  constexpr int pairs = 9;
  const double impacts = options.impacts() / pairs;
  std::vector<std::unique_ptr<Stage>> stages;
  std::vector<double> without, with, ratios;
  for (int pair = 0; pair < pairs; ++pair) {
    Room room = paper_cube(0.6);
    add(room);
    stages.push_back(std::make_unique<Stage>(paper_cube(0.6), settings, 0.1));
    stages.push_back(std::make_unique<Stage>(std::move(room), settings, 0.1));
    Stage& with_it = *stages[stages.size() - 1];
    Stage& without_it = *stages[stages.size() - 2];
    const Ratio one = compare_speeds(walking(without_it, impacts), walking(with_it, impacts), 2 * options.turns());
    without.push_back(one.first);
    with.push_back(one.second);
    ratios.push_back(one.value);
  }
  const Ratio ratio{median(ratios), median(without), median(with), ratios};
  return {"cost of " + what + " that is not used", 100.0 * (ratio.value - 1.0), 2.0, false, "%",
          details_of(ratio, "without", "with")};
}

Measured start_up(const Options& options) {
  std::vector<double> times;
  for (int turn = 0; turn < (options.quick ? 3 : 5); ++turn) {
    Room room = room_of_triangles(100'000);
    times.push_back(seconds_of([&] {
      Stage stage(std::move(room), settings_for(Estimator::collision, Engine::embree), 0.1);
      stage.walk(1.0);
    }));
  }
  return {"start to the first photons, 100 000 triangles", median(times), 1.0, false, "s", {{"times", times}}};
}

// In a separate process: the peak memory of a process never decreases.
Measured peak_memory() {
  const pid_t child = fork();
  if (child == 0) {
    Settings settings;
    settings.threads = 2;
    settings.photons = 1'000'000;
    settings.tile_edge_m = 1.0 / 408.0;
    const Result result = simulate(paper_cube(0.6), settings);
    _exit(result.tiles.size() > 990'000 ? 0 : 1);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const double megabytes = static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
  return {"peak memory, 1 M tiles, 2 threads", status == 0 ? megabytes : 1e9, 300.0, false, "MB", {}};
}

std::vector<Measured> measure_all(const Options& options) {
  std::vector<std::function<Measured()>> all;
  const auto add = [&](const std::string& group, const std::function<Measured()>& one) {
    if (options.only.empty() || options.only == group) all.push_back(one);
  };
  add("memory", peak_memory);
  add("textbook", [&] { return against_textbook(options, 0.6, 6.0); });
  add("textbook", [&] { return against_textbook(options, 0.9, 6.0); });
  for (const std::size_t triangles : std::vector<std::size_t>{12, 768, 11'000, 120'000})
    add("embree", [&options, triangles] { return against_raw_embree(options, triangles); });
  add("threads", [&] { return two_threads(options); });
  add("unused", [&] {
    return unused(options, "a receiver", [](Room& room) {
      room.receivers.push_back({"r", {0.5, 0.1, 0.5}, {0, 1, 0}, 90.0, 1.0});
    });
  });
  add("unused", [&] {
    return unused(options, "a spot and nine more emitters", [](Room& room) {
      room.emitters.push_back({"spot", 0.0, SpotEmitter{{0.5, 0.9, 0.5}, {0, -1, 0}, 0.1, 0.4}});
      for (int k = 0; k < 9; ++k) room.emitters.push_back({"more", 0.0, IsotropicEmitter{{0.1 * (k + 1), 0.5, 0.5}}});
    });
  });
  add("unused", [&] {
    return unused(options, "a measured luminaire", [](Room& room) {
      room.emitters.push_back(office_luminaire({0.5, 0.9, 0.5}, 0.0));
    });
  });
  add("tiles", [&] { return many_tiles(options); });
  add("start", [&] { return start_up(options); });
  add("estimators", [&] { return estimator(options, Estimator::weight); });
  add("estimators", [&] { return estimator(options, Estimator::absorption); });
  add("backward", [&] { return backward_speed(options); });
  add("backward", [&] { return backward_variance(options); });
  add("direct", [&] { return direct_light(options); });
  add("lamps", [&] { return many_lamps(options); });
  add("channel", [&] { return bins_to_one_percent(options); });
  std::vector<Measured> measured;
  const auto add_rows = [&](const std::string& group, std::vector<Measured> (*rows)(const Options&)) {
    if (!options.only.empty() && options.only != group) return;
    for (Measured& row : rows(options)) measured.push_back(std::move(row));
  };
  add_rows("points", points_rows);
  add_rows("channel", channel_rows);
  add_rows("luminaires", luminaire_rows);
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::cerr << "\r" << k + 1 << " of " << all.size() << "" << std::flush;
    measured.push_back(all[k]());
  }
  std::cerr << "\r\x1b[K";
  return measured;
}

const char* instructions() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return "AVX-512";
  if (__builtin_cpu_supports("avx2")) return "AVX2";
  return "SSE";
#else
  return "other";
#endif
}

std::string row(const Measured& one) {
  const std::string unit = one.unit.empty() ? "" : " " + one.unit;
  char text[240];
  if (!one.bar) {
    std::snprintf(text, sizeof text, "| %s | %.3g%s | – | |", one.what.c_str(), one.value, unit.c_str());
    return text;
  }
  std::snprintf(text, sizeof text, "| %s | %.3g%s | %s %.3g%s | %s |", one.what.c_str(), one.value, unit.c_str(),
                one.at_least ? "≥" : "≤", *one.bar, unit.c_str(), one.reached() ? "reached" : "MISSED");
  return text;
}

int run(const Options& options) {
  const std::vector<Measured> measured = measure_all(options);
  const bool all = std::all_of(measured.begin(), measured.end(), [](const Measured& one) { return one.reached(); });
  if (options.json) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Measured& one : measured) {
      rows.push_back({{"what", one.what},
                      {"value", one.value},
                      {"bar", one.bar ? nlohmann::ordered_json(*one.bar) : nlohmann::ordered_json()},
                      {"reached_if", one.at_least ? "at least" : "at most"},
                      {"unit", one.unit},
                      {"reached", one.reached()},
                      {"details", one.details}});
    }
    std::cout << nlohmann::ordered_json{{"version", version()},
                                        {"instructions", instructions()},
                                        {"processors", std::thread::hardware_concurrency()},
                                        {"turns", options.turns()},
                                        {"measured", rows}}
                     .dump(2)
              << '\n';
  } else {
    std::cout << "lichtmc " << version() << ", " << instructions() << ", one thread unless stated, medians of "
              << options.turns() << " turns\n\n| what | measured | limit | |\n|---|---|---|---|\n";
    for (const Measured& one : measured) std::cout << row(one) << '\n';
  }
  return all ? 0 : 1;
}

}  // namespace

static int run_program(int argc, char** argv) {
  Options options;
  CLI::App program{
      "Speed of lichtmc on this machine: ratios of alternating measurements, with their limits.\n"
      "Exit status 1 if a limit is missed."};
  program.add_flag("--json", options.json, "Write JSON, with every turn, instead of the table");
  program.add_flag("--quick", options.quick, "Shorter turns: under a minute");
  program.add_option("--only", options.only, "One group of measurements")
      ->check(CLI::IsMember(
          {"memory", "textbook", "embree", "threads", "unused", "tiles", "start", "estimators", "backward", "lamps", "points", "direct", "channel", "luminaires"}));
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : 2;
  }
  return run(options);
}

}  // namespace lichtmc::bench

int main(int argc, char** argv) {
  try {
    return lichtmc::bench::run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lichtmc_bench: %s\n", error.what());
  } catch (...) {
    std::fputs("lichtmc_bench: unknown error\n", stderr);
  }
  return 1;
}

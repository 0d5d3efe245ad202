// A state with a valid seal whose file another program has changed: types, rows, links, numbers.
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <hdf5.h>

#include "lichtmc/error.hpp"
#include "support/catch.hpp"
#include "support/rooms.hpp"
#include "support/state_files.hpp"

using namespace lichtmc;
using namespace lichtmc::test;

namespace {

// An object of HDF5.
class Opened {
 public:
  Opened(hid_t id, herr_t (*closer)(hid_t)) : id_(id), closer_(closer) { REQUIRE(id >= 0); }
  ~Opened() { closer_(id_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*closer_)(hid_t);
};

// A change by another program.
void change_file(const std::filesystem::path& file, const std::function<void(hid_t)>& change) {
  {
    const Opened hdf5(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    change(hdf5);
  }
  seal_again(file);
}

void put_attribute(hid_t file, const char* group, const char* name, hid_t type, const void* value) {
  H5Adelete_by_name(file, group, name, H5P_DEFAULT);
  const Opened space(H5Screate(H5S_SCALAR), H5Sclose);
  const Opened attribute(H5Acreate_by_name(file, group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  REQUIRE(H5Awrite(attribute, type, value) >= 0);
}

// An array without its rows.
void put_array(hid_t file, const char* name, hid_t type, std::vector<hsize_t> sizes, hid_t creation = H5P_DEFAULT) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const Opened space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
  const Opened array(H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
}

struct FileChange {
  std::string says;
  std::function<void(hid_t)> make;
};

void check_refused(const std::vector<FileChange>& changes) {
  const Scratch scratch;
  const StateData good = small_state(small_settings(Estimator::weight));
  for (const FileChange& change : changes) {
    INFO(change.says);
    write(good, scratch.file());
    change_file(scratch.file(), change.make);
    CHECK_THROWS_AS(read_state(scratch.file()), InputError);
    CHECK_THROWS_WITH(read_state(scratch.file()), ContainsSubstring(change.says));
  }
}

}  // namespace

TEST_CASE("numbers and text that are missing or of other types are refused") {
  const std::uint64_t seven = 7;
  const double huge = 1e300;
  check_refused({
      {"attribute seed is of another type",
       [&](hid_t f) { put_attribute(f, "/settings", "seed", H5T_IEEE_F64LE, &huge); }},
      {"attribute seed is of another type",
       [&](hid_t f) { put_attribute(f, "/settings", "seed", H5T_STD_U32LE, &seven); }},
      {"attribute seed is of another type",
       [&](hid_t f) { put_attribute(f, "/settings", "seed", H5T_STD_I64LE, &seven); }},
      {"attribute seed is of another type", [&](hid_t f) { put_attribute(f, "/settings", "seed", H5T_C_S1, "7"); }},
      {"attribute seconds is of another type",
       [&](hid_t f) { put_attribute(f, "/photons", "seconds", H5T_STD_U64LE, &seven); }},
      {"attribute engine is not text", [&](hid_t f) { put_attribute(f, "/", "engine", H5T_STD_U64LE, &seven); }},
      {"attribute note is not text of fixed length",
       [&](hid_t f) {
         const Opened type(H5Tcopy(H5T_C_S1), H5Tclose);
         H5Tset_size(type, H5T_VARIABLE);
         const char* text = "note";
         put_attribute(f, "/", "note", type, &text);
       }},
      {"the value of engine is not known: '7'", [&](hid_t f) { put_attribute(f, "/", "engine", H5T_C_S1, "7"); }},
      {"the value of part is not known: 7",
       [&](hid_t f) { put_attribute(f, "/settings", "part", H5T_STD_U64LE, &seven); }},
      {"the value of forward is not known: 1099511627776",
       [&](hid_t f) {
         const std::uint64_t wide = std::uint64_t{1} << 40;
         put_attribute(f, "/receivers", "forward", H5T_STD_U64LE, &wide);
       }},
      {"attribute seed is not a scalar",
       [&](hid_t f) {
         H5Adelete_by_name(f, "/settings", "seed", H5P_DEFAULT);
         const hsize_t one = 1;
         const Opened space(H5Screate_simple(1, &one, nullptr), H5Sclose);
         const Opened made(
             H5Acreate_by_name(f, "/settings", "seed", H5T_STD_U64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
             H5Aclose);
       }},
      {"cannot find an attribute", [](hid_t f) { H5Adelete_by_name(f, "/settings", "seed", H5P_DEFAULT); }},
      {"cannot find an attribute", [&](hid_t f) { H5Adelete_by_name(f, "/", "version", H5P_DEFAULT); }},
  });
}

TEST_CASE("rows of convergence that no number of histories has are refused") {
  for (const double histories : {std::numeric_limits<double>::quiet_NaN(), -1.0, 0x1p64, 1e300}) {
    check_refused({{"array convergence has a row after", [histories](hid_t f) {
                      const Opened array(H5Dopen2(f, "/photons/convergence", H5P_DEFAULT), H5Dclose);
                      const std::vector<double> rows{histories, 1.0, 0.1};
                      REQUIRE(H5Dwrite(array, H5T_IEEE_F64LE, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()) >= 0);
                    }}});
  }
}

TEST_CASE("rows that are not in the file take no memory") {
  const hsize_t many = 10'000'000'000;
  const auto chunked = [] {
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const std::vector<hsize_t> chunk{1024, 4};
    H5Pset_chunk(creation, 2, chunk.data());
    return creation;
  };
  check_refused({
      {"array tiles has 10000000000 rows",
       [&](hid_t f) {
         put_array(f, "/photons/tiles", H5T_STD_U64LE, {many, 4});
       }},
      {"array hits has 10000000000 rows", [&](hid_t f) { put_array(f, "/photons/hits", H5T_STD_U64LE, {many}); }},
      {"array tiles has 24 rows",
       [&](hid_t f) {
         put_array(f, "/photons/tiles", H5T_STD_U64LE, {24, 4});
       }},
      {"array sums has 144115188075855872 rows",
       [&](hid_t f) {
         put_array(f, "/receivers/sums", H5T_STD_U64LE, {hsize_t{1} << 57, 4});
       }},
      {"array absorbed has 2 rows",
       [&](hid_t f) {
         put_array(f, "/photons/absorbed", H5T_STD_U64LE, {2, 2});
       }},
      {"array convergence has 10000000000 rows",
       [&](hid_t f) {
         put_array(f, "/photons/convergence", H5T_IEEE_F64LE, {many, 3});
       }},
      {"array tiles has 10000000000 rows",
       [&](hid_t f) {
         const Opened creation(chunked(), H5Pclose);
         put_array(f, "/photons/tiles", H5T_STD_U64LE, {many, 4}, creation);
       }},
      {"array tiles has another shape",
       [](hid_t f) {
         put_array(f, "/photons/tiles", H5T_STD_U64LE, {24, 5});
       }},
      {"array tiles has another shape", [](hid_t f) { put_array(f, "/photons/tiles", H5T_STD_U64LE, {96}); }},
      {"array behind has another shape",
       [](hid_t f) {
         put_array(f, "/photons/behind", H5T_STD_U64LE, {6, 2, 1});
       }},
      {"array hits is of another type",
       [](hid_t f) {
         H5Ldelete(f, "/photons/hits", H5P_DEFAULT);
         const hsize_t rows = 24;
         const std::vector<double> values(rows, 1.0);
         const Opened space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
         const Opened array(
             H5Dcreate2(f, "/photons/hits", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
         H5Dwrite(array, H5T_IEEE_F64LE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
       }},
  });
}

TEST_CASE("arrays and groups that are elsewhere are refused") {
  check_refused({
      {"array hits has 24 rows",
       [](hid_t f) {
         const Opened creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
         H5Pset_external(creation, "/dev/zero", 0, H5F_UNLIMITED);
         put_array(f, "/photons/hits", H5T_STD_U64LE, {24}, creation);
       }},
      {"hits is a link to something elsewhere",
       [](hid_t f) {
         H5Ldelete(f, "/photons/hits", H5P_DEFAULT);
         H5Lcreate_soft("/photons/tiles", f, "/photons/hits", H5P_DEFAULT, H5P_DEFAULT);
       }},
      {"/receivers is a link to something elsewhere",
       [](hid_t f) {
         H5Ldelete(f, "/receivers", H5P_DEFAULT);
         H5Lcreate_external("other.h5", "/receivers", f, "/receivers", H5P_DEFAULT, H5P_DEFAULT);
       }},
      {"cannot find /settings", [](hid_t f) { H5Ldelete(f, "/settings", H5P_DEFAULT); }},
      {"cannot find ranges", [](hid_t f) { H5Ldelete(f, "/receivers/ranges", H5P_DEFAULT); }},
      {"cannot find an array",
       [](hid_t f) {
         H5Ldelete(f, "/photons/hits", H5P_DEFAULT);
         const Opened group(H5Gcreate2(f, "/photons/hits", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
       }},
      {"it has 4 groups and arrays, of which 3 are known",
       [](hid_t f) { H5Lmove(f, "/receivers", f, "/recievers", H5P_DEFAULT, H5P_DEFAULT); }},
      {"it has no /photons, which its settings request", [](hid_t f) { H5Ldelete(f, "/photons", H5P_DEFAULT); }},
  });
}

namespace {

// A position in the file of a 64-bit number or of a letter.
struct StoredMember {
  std::string group;
  std::string name;
  bool is_array = false;
};

std::vector<StoredMember> places_in(hid_t file) {
  std::vector<StoredMember> places;
  for (const char* group : {"/", "/settings", "/photons", "/receivers"}) {
    const Opened opened(H5Gopen2(file, group, H5P_DEFAULT), H5Gclose);
    for (unsigned k = 0; k < static_cast<unsigned>(H5Aget_num_attrs(opened)); ++k) {
      const Opened attribute(H5Aopen_idx(opened, k), H5Aclose);
      std::string name(64, '\0');
      name.resize(static_cast<std::size_t>(H5Aget_name(attribute, name.size(), name.data())));
      places.push_back({group, name, false});
    }
  }
  for (const char* name : {"ranges", "convergence", "absorbed", "escaped", "residual", "lost", "incident", "tiles",
                           "hits", "tile_maps", "behind"})
    places.insert(places.end(), 3, {"/photons", name, true});
  for (const char* name : {"ranges", "convergence", "sums"}) places.insert(places.end(), 3, {"/receivers", name, true});
  return places;
}

class Tampering {
 public:
  explicit Tampering(unsigned seed) : random_(seed) {}

  void change(hid_t file, const StoredMember& place) {
    const std::string path = place.group + "/" + place.name;
    if (place.is_array) {
      const Opened array(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose);
      const Opened type(H5Dget_type(array), H5Tclose);
      std::vector<char> bytes(H5Dget_storage_size(array));
      H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
      change_word(bytes);
      REQUIRE(H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0);
    } else {
      const Opened group(H5Gopen2(file, place.group.c_str(), H5P_DEFAULT), H5Gclose);
      const Opened attribute(H5Aopen(group, place.name.c_str(), H5P_DEFAULT), H5Aclose);
      const Opened type(H5Aget_type(attribute), H5Tclose);
      std::vector<char> bytes(H5Tget_size(type));
      H5Aread(attribute, type, bytes.data());
      H5Tget_class(type) == H5T_STRING ? change_byte(bytes) : change_word(bytes);
      REQUIRE(H5Awrite(attribute, type, bytes.data()) >= 0);
    }
  }

 private:
  void change_byte(std::vector<char>& bytes) { bytes[random_() % bytes.size()] = static_cast<char>(random_()); }
  // A byte of it, or a number that is critical for arithmetic.
  void change_word(std::vector<char>& bytes) {
    static const std::vector<std::uint64_t> numbers{0,
                                                    1,
                                                    1024,
                                                    std::uint64_t{1} << 32,
                                                    std::uint64_t{1} << 62,
                                                    (std::uint64_t{1} << 63) - 1,
                                                    std::uint64_t{1} << 63,
                                                    ~std::uint64_t{0},
                                                    0x7FF0'0000'0000'0000,   // infinity
                                                    0x7FF8'0000'0000'0000,   // NaN
                                                    0xC3E0'0000'0000'0000};  // −2⁶³
    if (random_() % 2 == 0) return change_byte(bytes);
    const std::uint64_t number = numbers[random_() % numbers.size()];
    const std::size_t word = random_() % (bytes.size() / sizeof number);
    std::memcpy(&bytes[word * sizeof number], &number, sizeof number);
  }

  std::mt19937 random_;
};

}  // namespace

// If a file is read, results are computed from it or refused.
TEST_CASE("if any number of a state is changed, it is refused or results are computed from it") {
  const Scratch scratch;
  const Room room = small_room();
  const StateData good = small_state(small_settings(Estimator::weight));
  write(good, scratch.file());
  const std::string whole = bytes_of(scratch.file());
  std::vector<StoredMember> places;
  change_file(scratch.file(), [&](hid_t file) { places = places_in(file); });
  REQUIRE(places.size() > 70);
  Tampering tampering(1);
  std::mt19937 random(2);
  std::size_t refused = 0;
  for (int k = 0; k < 2000; ++k) {
    write_bytes(scratch.file(), whole);
    const StoredMember& place = places[random() % places.size()];
    change_file(scratch.file(), [&](hid_t file) { tampering.change(file, place); });
    INFO(place.group << "/" << place.name);
    try {
      const State state = read_state(scratch.file());
      // Another number of tiles may take any time and memory.
      if (state.settings().tile_edge_m == good.settings.tile_edge_m) result_of(room, state);
    } catch (const Error&) {
      ++refused;
    }
  }
  // About half of the changes are found; the others are to scores, which may have any value within their bounds. The
  // numbers are drawn with fixed seeds, so that this count changes with the fields of a state only.
  CHECK(refused > 900);
}

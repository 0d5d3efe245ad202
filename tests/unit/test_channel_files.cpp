// The files of impulse responses: what is written is read back with the libraries that users have.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <hdf5.h>
#include <matio.h>
#include <nlohmann/json.hpp>

#include "base/csv.hpp"
#include "lichtmc/output.hpp"
#include "output/channels_mat.hpp"
#include "support/catch.hpp"
#include "support/small_channels.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

std::vector<CsvRow> rows_of(const fs::path& file) {
  std::ifstream in(file);
  REQUIRE(in);
  CsvReader reader(in, ',');
  std::vector<CsvRow> rows;
  for (CsvRow row; reader.next(row);) rows.push_back(row);
  return rows;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE(in);
  return {std::istreambuf_iterator<char>(in), {}};
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

// An HDF5 object that closes itself.
struct Opened {
  hid_t id;
  herr_t (*close)(hid_t);
  Opened(hid_t opened, herr_t (*closer)(hid_t)) : id(opened), close(closer) { REQUIRE(id >= 0); }
  ~Opened() { close(id); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  operator hid_t() const { return id; }
};

struct Array {
  std::vector<std::size_t> sizes;
  std::vector<double> values;
};

Array array_of(hid_t file, const std::string& name) {
  const Opened set(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Opened space(H5Dget_space(set), H5Sclose);
  std::array<hsize_t, 4> sizes{};
  const int rank = H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  Array array{{sizes.begin(), sizes.begin() + rank}, {}};
  array.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  REQUIRE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) >= 0);
  return array;
}

std::vector<std::string> names_of(hid_t file, const char* name) {
  const Opened set(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  const Opened space(H5Dget_space(set), H5Sclose);
  const Opened type(H5Dget_type(set), H5Tclose);
  std::vector<char*> texts(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  REQUIRE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts.data()) >= 0);
  std::vector<std::string> names(texts.begin(), texts.end());
  H5Dvlen_reclaim(type, space, H5P_DEFAULT, texts.data());
  return names;
}

std::string text_attribute(hid_t file, const char* of, const char* name) {
  const Opened attribute(H5Aopen_by_name(file, of, name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Opened type(H5Aget_type(attribute), H5Tclose);
  char* text = nullptr;
  REQUIRE(H5Aread(attribute, type, &text) >= 0);
  const std::string copy(text);
  H5free_memory(text);
  return copy;
}

double number_attribute(hid_t file, const char* of, const char* name) {
  const Opened attribute(H5Aopen_by_name(file, of, name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  double value = 0.0;
  REQUIRE(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) >= 0);
  return value;
}

struct CloseMat {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

std::vector<std::size_t> sizes_of(const matvar_t& variable) {
  return {variable.dims, variable.dims + variable.rank};
}

const double* doubles_of(const matvar_t& variable) {
  REQUIRE(variable.data_type == MAT_T_DOUBLE);
  return static_cast<const double*>(variable.data);
}

}  // namespace

TEST_CASE("impulse_response.csv has a row for every emitter, receiver, order and bin") {
  const Folder folder;
  const Result result = make_channel_result();
  const ImpulseResponses& r = *result.channels;
  write_results(make_room(), result, folder.path());
  CHECK(
      text_of(folder.path() / "impulse_response.csv").starts_with("emitter,receiver,order,time_s,h,standard_error\n"));
  const std::vector<CsvRow> rows = rows_of(folder.path() / "impulse_response.csv");
  REQUIRE(rows.size() == 1 + 2 * 3 * 5 * 10);
  std::size_t at = 1;
  const std::array<std::string, 5> orders{"0", "1", "2", "3+", "all"};
  for (std::size_t e = 0; e < 2; ++e) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t order = 0; order < 5; ++order) {
        for (std::size_t bin = 0; bin < 10; ++bin, ++at) {
          const std::vector<CsvField>& fields = rows[at].fields;
          REQUIRE(fields.size() == 6);
          CHECK(fields[0].text == r.emitters[e]);
          CHECK(fields[1].text == r.receivers[k]);
          CHECK(fields[2].text == orders.at(order));
          CHECK(std::stod(fields[3].text) == (static_cast<double>(bin) + 0.5) * r.bin_width_s);
          const bool all = order == 4;
          CHECK(std::stod(fields[4].text) == (all ? r.h_all[r.row(e, k) + bin] : r.h[r.row(e, k, order) + bin]));
          CHECK(std::stod(fields[5].text) ==
                (all ? r.standard_error_all[r.row(e, k) + bin] : r.standard_error[r.row(e, k, order) + bin]));
        }
      }
    }
  }
}

TEST_CASE("channels.csv has the derived figures with their errors; what does not exist is nan") {
  const Folder folder;
  Result result = make_channel_result();
  write_results(make_room(), result, folder.path());
  std::vector<CsvRow> rows = rows_of(folder.path() / "channels.csv");
  REQUIRE(rows.size() == 1 + 6);
  std::map<std::string, std::size_t> column;
  for (std::size_t k = 0; k < rows[0].fields.size(); ++k) column[rows[0].fields[k].text] = k;
  for (const CsvRow& row : rows) REQUIRE(row.fields.size() == column.size());
  const auto field = [&](std::size_t row, const std::string& name) {
    REQUIRE(column.contains(name));
    return rows[row].fields[column[name]].text;
  };
  CHECK(field(1, "emitter") == "a \"b\", c");
  CHECK(field(2, "receiver") == "second, half");
  CHECK(std::stod(field(4, "gain")) == 4e-6);
  CHECK(std::stod(field(4, "gain_db")) == 10.0 * std::log10(4e-6));
  CHECK(std::stod(field(4, "gain_db_standard_error")) == Approx(10.0 * std::log10(1.0 + 1e-9 / 4e-6)).epsilon(1e-3));
  CHECK(field(1, "first_arrival") == "exact");
  CHECK(field(2, "first_arrival") == "upper-bound");
  CHECK(field(3, "first_arrival") == "none");
  CHECK(field(3, "gain_db") == "nan");
  CHECK(field(1, "bandwidth_optical_hz") == "nan");
  CHECK(std::stod(field(1, "bandwidth_electrical_hz_standard_error")) == 2e4);
  CHECK(std::stod(field(6, "beyond_time_span")) == 1e-9 * 6.0);
  CHECK_FALSE(column.contains("squared_rms_delay_spread_s"));
  CHECK_FALSE(column.contains("first_arrival_s_standard_error"));

  result.settings.channel.squared_weights = true;
  write_results(make_room(), result, folder.path());
  CHECK_THAT(text_of(folder.path() / "channels.csv"),
             ContainsSubstring(",squared_rms_delay_spread_s,squared_rms_delay_spread_s_standard_error,"));
}

TEST_CASE("channels.h5 has all arrays with units, and the settings") {
  const Folder folder;
  const Result result = make_channel_result();
  const ImpulseResponses& r = *result.channels;
  write_results(make_room(), result, folder.path());
  const Opened file(H5Fopen((folder.path() / "channels.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);

  const Array h = array_of(file, "h");
  CHECK(h.sizes == std::vector<std::size_t>{2, 3, 4, 10});
  CHECK(h.values == r.h);
  CHECK(array_of(file, "standard_error").values == r.standard_error);
  CHECK(array_of(file, "h_all").sizes == std::vector<std::size_t>{2, 3, 10});
  CHECK(array_of(file, "h_all").values == r.h_all);
  CHECK(array_of(file, "standard_error_all").values == r.standard_error_all);
  CHECK(array_of(file, "bin_edges_s").values.size() == 11);
  CHECK(array_of(file, "bin_edges_m").values[10] == 10.0 * 1e-9 * 299792458.0);
  CHECK(array_of(file, "t").values[3] == 3.5 * 1e-9);
  CHECK(names_of(file, "emitter") == r.emitters);
  CHECK(names_of(file, "receiver") == r.receivers);
  CHECK(names_of(file, "order") == std::vector<std::string>{"0", "1", "2", "3+"});
  CHECK(array_of(file, "response_imag").values[3] == -0.3e-6);
  CHECK(array_of(file, "order_gain").values[7] == r.order_gain[7].value);
  CHECK(std::isnan(array_of(file, "order_beyond_time_span_standard_error").values[0]));
  CHECK(array_of(file, "receiver_position_m").sizes == std::vector<std::size_t>{3, 3});
  CHECK(array_of(file, "receiver_position_m").values[8] == 0.25);
  CHECK(array_of(file, "receiver_optical_gain").values[1] == result.receivers[1].optical_gain());
  CHECK(std::isnan(array_of(file, "receiver_concentrator_index").values[0]));
  CHECK(array_of(file, "emitter_delay_s").values[0] == 5e-9);

  const Array gain = array_of(file, "derived/gain");
  CHECK(gain.sizes == std::vector<std::size_t>{2, 3});
  CHECK(gain.values[5] == 6e-6);
  CHECK(array_of(file, "derived/gain_standard_error").values[5] == 1e-9);
  CHECK(std::isnan(array_of(file, "derived/bandwidth_optical_hz").values[0]));
  CHECK(array_of(file, "derived/first_arrival_is_exact").values == std::vector<double>{1, 0, 0, 0, 0, 0});

  CHECK(text_attribute(file, "h", "unit") == "1/s");
  CHECK(text_attribute(file, "h", "dimensions") == "emitter, receiver, order, bin");
  CHECK_THAT(text_attribute(file, "/", "description"), ContainsSubstring("per power of that emitter"));
  CHECK(number_attribute(file, "settings", "bin_width_s") == 1e-9);
  CHECK(text_attribute(file, "settings", "time_span_s") == "none");
  CHECK(number_attribute(file, "settings", "per_emitter") == 1.0);
  CHECK(text_attribute(file, "settings", "estimator") == "weight");
  CHECK(H5Aexists_by_name(file, "settings", "threads", H5P_DEFAULT) == 0);
}

TEST_CASE("large arrays of channels.h5 are compressed in chunks and hold the same numbers") {
  const Folder folder;
  Result result = make_channel_result();
  ImpulseResponses& r = *result.channels;
  r.bins = 5000;
  r.h.assign(2 * 3 * 4 * r.bins, 0.0);
  for (std::size_t k = 0; k < r.h.size(); k += 3) r.h[k] = std::sin(static_cast<double>(k));
  r.standard_error = r.h;
  r.h_all.assign(2 * 3 * r.bins, 0.5);
  r.standard_error_all = r.h_all;
  write_results(make_room(), result, folder.path());
  const Opened file(H5Fopen((folder.path() / "channels.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  CHECK(array_of(file, "h").values == r.h);
  const Opened set(H5Dopen2(file, "h", H5P_DEFAULT), H5Dclose);
  CHECK(H5Dget_storage_size(set) < r.h.size() * sizeof(double) / 2);
}

TEST_CASE("channels.mat has the arrays with reversed dimensions") {
  const Folder folder;
  const Result result = make_channel_result();
  const ImpulseResponses& r = *result.channels;
  write_results(make_room(), result, folder.path());
  const std::unique_ptr<mat_t, CloseMat> mat(Mat_Open((folder.path() / "channels.mat").c_str(), MAT_ACC_RDONLY));
  REQUIRE(mat);
  CHECK(Mat_GetVersion(mat.get()) == MAT_FT_MAT5);
  const auto variable = [&](const char* name) {
    Variable found(Mat_VarRead(mat.get(), name));
    REQUIRE(found);
    return found;
  };
  const Variable h = variable("h");
  CHECK(sizes_of(*h) == std::vector<std::size_t>{10, 4, 3, 2});
  CHECK(std::equal(r.h.begin(), r.h.end(), doubles_of(*h)));
  CHECK(sizes_of(*variable("t")) == std::vector<std::size_t>{10, 1});
  CHECK(sizes_of(*variable("bin_width_s")) == std::vector<std::size_t>{1, 1});
  const Variable derived = variable("derived");
  const matvar_t* spread = Mat_VarGetStructFieldByName(derived.get(), "rms_delay_spread_s", 0);
  REQUIRE(spread != nullptr);
  CHECK(sizes_of(*spread) == std::vector<std::size_t>{3, 2});
  for (std::size_t k = 0; k < 6; ++k) CHECK(same(doubles_of(*spread)[k], r.channels[k].rms_delay_spread_s.value));
  const Variable names = variable("emitter");
  REQUIRE(sizes_of(*names) == std::vector<std::size_t>{2, 1});
  matvar_t* name = Mat_VarGetCell(names.get(), 1);
  CHECK(sizes_of(*name) == std::vector<std::size_t>{1, 11});
  REQUIRE(name->data_type == MAT_T_UTF16);
  const auto* units = static_cast<const std::uint16_t*>(name->data);
  CHECK(std::vector<std::uint16_t>(units + 8, units + 11) == std::vector<std::uint16_t>{0xD8, ' ', 0xFFFD});
  // Not a single channel.
  CHECK(Variable(Mat_VarRead(mat.get(), "averun2")) == nullptr);
}

TEST_CASE("channels.mat of one channel in bins of 1 ns also has the names of the 802.11bb models") {
  const Folder folder;
  Result result = make_channel_result();
  ImpulseResponses& r = *result.channels;
  r.emitters.resize(1);
  r.receivers.resize(1);
  r.powers.resize(1);
  r.delays_s.resize(1);
  r.channels.resize(1);
  r.h.resize(4 * 10);
  r.standard_error.resize(4 * 10);
  r.h_all.resize(10);
  r.standard_error_all.resize(10);
  for (auto* list : {&r.order_gain, &r.order_beyond}) list->resize(4);
  r.order_first_s.resize(4);
  r.response.resize(2);
  r.magnitude_error.resize(2);
  write_results(make_room(), result, folder.path());
  const std::unique_ptr<mat_t, CloseMat> mat(Mat_Open((folder.path() / "channels.mat").c_str(), MAT_ACC_RDONLY));
  REQUIRE(mat);
  const Variable number(Mat_VarRead(mat.get(), "averun1"));
  const Variable gain(Mat_VarRead(mat.get(), "averun2"));
  REQUIRE((number && gain));
  CHECK(sizes_of(*gain) == std::vector<std::size_t>{10, 1});
  for (std::size_t k = 0; k < 10; ++k) {
    CHECK(doubles_of(*number)[k] == static_cast<double>(k + 1));
    CHECK(doubles_of(*gain)[k] == r.h_all[k] * 1e-9);
  }
}

TEST_CASE("channels.mat is left out, with the reason, if an array is too large for the format") {
  Result result = make_channel_result();
  CHECK(obstacle_to_channels_mat(result).empty());
  CHECK(files_left_out(result).empty());
  result.channels->bins = (std::size_t{1} << 31) / sizeof(double) / 4 / 6 + 1;
  CHECK_THAT(obstacle_to_channels_mat(result),
             ContainsSubstring("channels.mat is not written, because h has 2048 MiB"));
  REQUIRE(files_left_out(result).size() == 1);
  CHECK_THAT(summary_json(make_room(), result), ContainsSubstring("channels.mat is not written"));
  result.channels.reset();
  CHECK(files_left_out(result).empty());
}

TEST_CASE("summary.json has the channels with their gains by order") {
  const Result result = make_channel_result();
  const Json summary = Json::parse(summary_json(make_room(), result));
  REQUIRE(summary["channels"].size() == 6);
  REQUIRE(summary["receivers"].size() == 3);
  const Json& channel = summary["channels"][1];
  CHECK(channel["emitter"] == "a \"b\", c");
  CHECK(channel["receiver"] == "second, half");
  CHECK(channel["gain"] == 2e-6);
  CHECK(channel["first_arrival"] == "upper-bound");
  CHECK(channel["bandwidth_optical_hz"].is_null());
  REQUIRE(channel["orders"].size() == 4);
  CHECK(channel["orders"][3]["order"] == "3+");
  CHECK(channel["orders"][3]["gain"] == 0.1 * 4.0);
  CHECK(summary["impulse_responses"]["time_span_s"] == 10 * 1e-9);
  CHECK(summary["receivers"][1]["concentrator_index"] == 1.5);
  CHECK(summary["receivers"][0]["concentrator_index"].is_null());
  CHECK(summary["receivers"][0]["filter_gain"] == 0.5);
  CHECK_FALSE(Json::parse(summary_json(make_room(), make_result())).contains("channels"));
}

TEST_CASE("files of impulse responses of an earlier run are removed") {
  const Folder folder;
  Result result = make_channel_result();
  const std::array<const char*, 4> names{"impulse_response.csv", "channels.csv", "channels.h5", "channels.mat"};
  write_results(make_room(), result, folder.path());
  for (const char* name : names) CHECK(fs::exists(folder.path() / name));
  result.channels.reset();
  write_results(make_room(), result, folder.path());
  for (const char* name : names) CHECK_FALSE(fs::exists(folder.path() / name));
}

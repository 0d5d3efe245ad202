// Photometric files of tests, with their figures: tests/data/luminaires, and the folder "luminaires" beside
// LICHTMC_ROOMS, whose files are of other authors and may be absent.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "lichtmc/photometry.hpp"

namespace lichtmc::test {

// A file of tests/data/luminaires.
std::filesystem::path photometric_file(const std::string& name);
// The folder of other authors' files.
std::filesystem::path foreign_luminaires();

// A row of a table with tabs: column → text. The column "path" has the file that the row is about.
using TableRow = std::map<std::string, std::string>;
std::vector<TableRow> rows_of(const std::filesystem::path& table);
// The rows about the figures of files, of both folders.
std::vector<TableRow> photometric_figures();

// In what a luminaire differs from the figures of a row: candela in ten directions and the maximum by more than 10⁻⁶ of
// the maximum (they have eight digits), fluxes by more than 10⁻⁶, format, version, type, symmetry, factor, warning.
// Empty: in nothing.
std::vector<std::string> deviations(const Photometry& photometry, const TableRow& row);

// A luminaire with another table, of the same file.
Photometry with_grid(const Photometry& photometry, CandelaTable::Grid grid);

}  // namespace lichtmc::test

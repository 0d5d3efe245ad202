// Tables of receivers: columns by their names, separators, decimal commas, and what is refused.
#include <fstream>
#include <string>
#include <vector>

#include "base/csv.hpp"
#include "lichtmc/error.hpp"
#include "lichtmc/output.hpp"
#include "lichtmc/receiver_table.hpp"
#include "support/catch.hpp"
#include "support/small_result.hpp"

using namespace lichtmc;
using namespace lichtmc::test;
using namespace std::string_literals;

namespace {

const glm::dvec3 place{1.5, 0.85, 2.0};
const glm::dvec3 up{0.0, 1.0, 0.0};

// Reads a table of one receiver at `place` with the normal `up`.
Receiver only(const std::string& bytes) {
  CAPTURE(bytes);
  const ReceiverTable table = parse_receiver_table(bytes, "f.csv");
  REQUIRE(table.receivers.size() == 1);
  const Receiver& receiver = table.receivers.front();
  CHECK(receiver.position == place);
  CHECK(receiver.normal == up);
  return receiver;
}

void refused(const std::string& bytes, const std::vector<std::string>& words) {
  CAPTURE(bytes);
  try {
    parse_receiver_table(bytes, "f.csv");
    FAIL("the table was accepted");
  } catch (const InputError& error) {
    const std::string message = error.what();
    CAPTURE(message);
    CHECK(message.starts_with("f.csv"));
    for (const std::string& word : words) CHECK_THAT(message, ContainsSubstring(word));
  }
}

}  // namespace

TEST_CASE("receiver tables: columns are found by their names, in any order, case and form") {
  only("x,y,z,nx,ny,nz\n1.5,.85,2,0,1,0\n");
  only("x,z,y,nx,nz,ny\n1.5,2,0.85,0,0,1\n");
  only("NZ, NY ,Nx,Z,\"Y\", \"X\" \n0,1,0,2,0.85,1.5\n");
  only("x (m),y [m],z/m,nx,ny (1),nz [-]\n1.5,0.85,2,0,1,0\n");
  only("x ( M ),y [metres],z / m,nx,ny,nz\n1.5,0.85,2,0,1,0\n");
  CHECK(only("name,x,y,z,nx,ny,nz\n desk ,1.5,0.85,2,0,1,0\n").name == "desk");
  CHECK(only("name,x,y,z,nx,ny,nz\n\" desk, left\",1.5,0.85,2,0,1,0\n").name == " desk, left");
  CHECK(only("name,x,y,z,nx,ny,nz\n7,1.5,0.85,2,0,1,0\n").name == "7");
  CHECK(only("name,x,y,z,nx,ny,nz\n,1.5,0.85,2,0,1,0\n").name == "receiver_0");
}

TEST_CASE("receiver tables: a heading in a comment counts, other comments do not") {
  only("# x,z,y,nx,nz,ny\n1.5,2,0.85,0,0,1\n");
  only("# x z y nx nz ny\n1.5,2,0.85,0,0,1\n");
  only("# points of \"room 3\nx,y,z,nx,ny,nz\n# x,z,y,nx,nz,ny\n1.5,0.85,2,0,1,0\n");
  only("# one, two\n\n1.5,0.85,2,0,1,0\n  # end");
}

TEST_CASE("receiver tables: other columns are named in a note") {
  const ReceiverTable table = parse_receiver_table("id,x,y,z,nx,ny,nz,lux (lx),\n1,1.5,0.85,2,0,1,0,53,\n", "f.csv");
  REQUIRE(table.notes.size() == 1);
  CHECK(table.notes[0] == "f.csv: the columns 'id', 'lux (lx)', (no name) are not read.");
  CHECK(parse_receiver_table("x,y,z,nx,ny,nz,a\n1,1,1,0,1,0,53\n", "f.csv").notes[0] ==
        "f.csv: the column 'a' is not read.");
  CHECK(parse_receiver_table("x,y,z,nx,ny,nz\n1,1,1,0,1,0\n", "f.csv").notes.empty());
  const ReceiverTable foreign = parse_receiver_table("1;1;1;0;1;0;T\xC3\xBCr\n1;1;1;0;1;0;T\xFCr\n", "f.csv");
  CHECK(foreign.receivers[1].name == "T\xFCr");
  REQUIRE(foreign.notes.size() == 1);
  CHECK_THAT(foreign.notes[0], ContainsSubstring("row 2") && ContainsSubstring("UTF-8"));
}

TEST_CASE("receiver tables: without a heading the columns are x,y,z,nx,ny,nz and name") {
  CHECK(only("1.5,0.85,2,0,1,0").name == "receiver_0");
  CHECK(only("+1.5,8.5e-1,2.,0,1,-0,desk 1").name == "desk 1");
  CHECK(only("1.5,0.85,2,0,1,0,x").name == "x");
  CHECK(only("1.5,0.85,2,0,1,0,").name == "receiver_0");
  const ReceiverTable table = parse_receiver_table("1,1,1,0,1,0,a\n\n,,,,,,\n1,2,1,0,1,0\n", "f.csv");
  REQUIRE(table.receivers.size() == 2);
  CHECK(table.receivers[1].name == "receiver_1");
}

TEST_CASE("receiver tables: separators, and decimal commas where commas do not separate") {
  for (const std::string& name : {""s, ";a,b c"s}) {
    const std::string heading = name.empty() ? "x;y;z;nx;ny;nz" : "x;y;z;nx;ny;nz;name";
    only(heading + "\r\n1,5;0,85;2;0;1,0;0" + name + "\r\n");
    only("1,5;0,85;2,0;0,0;1,0;0,0" + name);
    only("1.5;0.85;2;0;1;0" + name);
  }
  only("x\ty\tz\tnx\tny\tnz\n1,5\t0,85\t2\t0\t1\t0\n");
  only("1.5\t0.85\t2\t0\t1\t0\tdesk; left, back");
  only("sep=;\n1,5;0,85;2,0;0,0;1,0;0,0\n");
  only("sep=,\nx,y,z,nx,ny,nz\n1.5,0.85,2,0,1,0\n");
  only("  1.5  0.85 2\t0 1 0 \n");
  only("1,5 0,85 2 0 1 0\n");
  only("x y z nx ny nz name\n1.5 0.85 2 0 1 0 \"desk 1\"\n");
  CHECK(only("1.5;0.85;2;0;1;0;left, front").name == "left, front");
}

TEST_CASE("receiver tables: files of spreadsheet programs") {
  only("\xEF\xBB\xBFx,y,z,nx,ny,nz\r\n1.5,0.85,2,0,1,0\r\n");
  only("\"x\",\"y\",\"z\",\"nx\",\"ny\",\"nz\"\n\"1.5\",\"0.85\",\"2\",\"0\",\"1\",\"0\"\n");
  only("x,y,z,nx,ny,nz\r1.5,0.85,2,0,1,0\r");
  std::string wide = "\xFF\xFE";
  for (const char c : "x;y;z;nx;ny;nz\r\n1,5;0,85;2;0;1;0\r\n"s) wide += {c, '\0'};
  only(wide);
  CHECK(only("x,y,z,nx,ny,nz,name\n1.5,0.85,2,0,1,0,\"line 1\nline \"\"2\"\"\"\n").name == "line 1\nline \"2\"");
}

TEST_CASE("receiver tables: a row that does not fit the columns is an error with both counts") {
  refused("x,y,z,nx,ny,nz\n1,5,0,85,2,0,0,1,0\n",
          {"row 2", "9 fields", "the heading has 6", "decimal comma", "thousands"});
  refused("1,50,0,85,2,00,0,00,1,00,0,00\n", {"row 1", "12 fields", "decimal comma"});
  refused("x,y,z,nx,ny,nz,name\n1,2,3,0,1,0\n", {"row 2", "6 fields", "the heading has 7"});
  refused("1,2,3,0,1,0,left, front\n", {"row 1", "8 fields", "quotes"});
  refused("x,y,z,nx,ny,nz\n1;2;3;0;1;0\n", {"row 2", "1 field,", "separated by commas"});
  refused("x;y;z;nx;ny;nz\n1,2,3,0,1,0\n", {"row 2", "1 field,", "separated by semicolons"});
  refused("1.5 0.85 2 0 1 0 desk 1\n", {"row 1", "8 fields", "separated by blanks"});
  refused("x,y,z,nx,ny,nz\n\n\n1,2\n", {"row 4", "2 fields"});
}

TEST_CASE("receiver tables: a number is a name only where a heading says so") {
  refused("1,500.5,0.85,2,0,1,0\n", {"row 1", "seventh", "'0'", "heading"});
  refused("1,5,0,2,0,1,0\n", {"row 1", "seventh", "decimal commas"});
}

TEST_CASE("receiver tables: headings that do not name what is needed") {
  refused("x,y,z\n1,2,3\n", {"row 1", "without nx, ny, nz", "allowed"});
  refused("px,py,pz,dx,dy,dz\n1,2,3,0,1,0\n", {"without x, y, z, nx, ny, nz", "'px'"});
  refused("x,y,z,nx,ny,nz,X\n1,2,3,0,1,0,1\n", {"'X' twice"});
  refused("name,x,y,z,nx,ny,nz,Name\na,1,2,3,0,1,0,b\n", {"'Name' twice"});
  refused("x (mm),y (mm),z (mm),nx,ny,nz\n1,2,3,0,1,0\n", {"'x (mm)'", "metres"});
  refused("x,y,z,nx (m),ny,nz\n1,2,3,0,1,0\n", {"'nx (m)'"});
  refused("x,y,z,nx,ny,nz\nm,m,m,1,1,1\n1,2,3,0,1,0\n", {"row 2", "'m'", "column x"});
  refused("lamp,1,2,3,0,1\n", {"row 1", "'lamp'", "column x"});
  refused("sep=|\n1|2|3|0|1|0\n", {"row 1", "'|'"});
}

TEST_CASE("receiver tables: values that are no number of one meaning") {
  for (const auto& [value, words] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{{"nan", {"not finite"}},
                                                                     {"inf", {"not finite"}},
                                                                     {"-Infinity", {"not finite"}},
                                                                     {"1e999", {"range"}},
                                                                     {"0x10", {"not a number"}},
                                                                     {"1.5m", {"not a number"}},
                                                                     {"+-1", {"not a number"}},
                                                                     {"--1", {"not a number"}},
                                                                     {"1e", {"not a number"}},
                                                                     {"\"1,500.5\"", {"thousands"}},
                                                                     {"1 500.5", {"thousands"}},
                                                                     {"1\xC2\xA0"
                                                                      "500",
                                                                      {"thousands"}},
                                                                     {"1'500", {"thousands"}},
                                                                     {"\"1,5\"", {"comma", "semicolons"}},
                                                                     {"", {"empty"}}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"row 3", "column y"});
    refused("x,y,z,nx,ny,nz\n0,0,0,0,1,0\n1," + value + ",2,0,1,0\n", all);
  }
  refused("x;y;z;nx;ny;nz\n1.500,5;1;2;0;1;0\n", {"row 2", "thousands"});
  refused("x;y;z;nx;ny;nz\n1,500;0.85;2;0;1;0\n", {"decimal points, first in row 2", "decimal commas, first in row 2"});
  refused("x;y;z;nx;ny;nz\n1;0.85;2;0;1;0\n1;2;3;0;1,0;0\n", {"first in row 2", "first in row 3"});
  refused("x,y,z,nx,ny,nz\n1,2,3,0,0,0\n", {"row 2", "normal 0,0,0"});
}

TEST_CASE("receiver tables: tables without receivers, quotes that do not close, files that are not tables") {
  for (const std::string& bytes : {""s, "\n\n"s, "# nothing\n"s, "x,y,z,nx,ny,nz\n"s, "\xEF\xBB\xBF"s})
    refused(bytes, {"no receiver", "x,y,z,nx,ny,nz"});
  refused("x,y,z,nx,ny,nz,name\n1,2,3,0,1,0,\"a\n4,5,6,0,1,0,b\n", {"row 2", "not closed"});
  refused("x,y,z,nx,ny,nz,name\n1,2,3,0,1,0,\"a\"b\n", {"row 2", "closing quote"});
  refused("PK\x03\x04\x14", {"spreadsheet program", "CSV"});
  refused("1\0,\0"s, {"UTF-16", "CSV"});
  CHECK_THROWS_WITH(read_receiver_table("/dev/zero"), ContainsSubstring("/dev/zero") && ContainsSubstring("regular"));
  CHECK_THROWS_WITH(read_receiver_table("/none.csv"), ContainsSubstring("Cannot read '/none.csv'"));
}

TEST_CASE("receiver tables: receivers.csv of a run is one, whatever the names are") {
  const Folder folder;
  Result result = make_result();
  const std::vector<std::string> names{"a", "b\nc", "say \"so\", or not", " d ", "e\r\nf", "g\0h"s, "\xFF", "#i", "7"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    Receiver receiver;
    receiver.name = names[k];
    receiver.position = {0.1 * static_cast<double>(k), 1.0 / 3.0, -1e-7};
    receiver.normal = {0.0, -0.6, 0.8};
    result.receivers.push_back(receiver);
    result.receiver_results.emplace_back();
  }
  write_results(make_room(), result, folder.path());
  const ReceiverTable table = read_receiver_table(folder.path() / "receivers.csv");
  REQUIRE(table.receivers.size() == names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    CHECK(table.receivers[k].name == names[k]);
    CHECK(table.receivers[k].position == result.receivers[k].position);
    CHECK(table.receivers[k].normal == result.receivers[k].normal);
  }
  CHECK_THAT(table.notes.at(1), ContainsSubstring("'receiver', 'irradiance'"));
}

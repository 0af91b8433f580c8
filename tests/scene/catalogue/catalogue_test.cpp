/// Catalogues: rows and what is handed on; lines of threads in order.
#include "nlmech/scene/catalogue/catalogue.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "nlmech/scene/program/files.hpp"
#include "nlmech/support/errors.hpp"
#include "tests/scene/temporary_folder.hpp"

namespace nlmech::scene::catalogue_test {
namespace {

using tests::TemporaryFolder;

TEST(Catalogue, RowsByName) {
  const TemporaryFolder folder;
  write_whole(folder.path() / "a.csv",
              "\xEF\xBB\xBF#x, y\r\n # z\r\n\r\n name , b,a\r\n\r\n\"p, q\", 2 , 1\r\n,4,3\n\"\",-6,+5");
  Catalogue catalogue((folder.path() / "a.csv").string(), {"a"}, {"b", "c"}, {});
  EXPECT_TRUE(catalogue.has("b"));
  EXPECT_FALSE(catalogue.has("c"));
  EXPECT_EQ(catalogue.columns().rest_names(), ",name");
  EXPECT_EQ(catalogue.rows(), 3);
  const CatalogueRows two = catalogue.next({2});
  ASSERT_EQ(two.line.size(), 2U);
  EXPECT_EQ(two.line[0], 6U);
  EXPECT_EQ(two.rest[0], ",\"p, q\"");
  EXPECT_EQ(two.rest[1], ",");
  EXPECT_EQ(two.numbers[1][0], 3);
  EXPECT_EQ(two.numbers[1][1], 4);
  EXPECT_TRUE(std::isnan(two.numbers[1][2]));
  const CatalogueRows one = catalogue.next({2});
  EXPECT_EQ(one.first, 3);
  ASSERT_EQ(one.line.size(), 1U);
  EXPECT_EQ(one.numbers[0][0], 5);
  EXPECT_TRUE(catalogue.next({2}).line.empty());
}

// Behind the header '#' begins no comment: such a line is a row, or it is refused.
TEST(Catalogue, NoRowVanishesBehindASharp) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "a.csv").string();
  write_whole(file, "# comment\nname,a\n#1,5\n#2,6\n\n3,7\n");
  Catalogue catalogue(file, {"a"}, {}, {});
  const CatalogueRows rows = catalogue.next({9});
  EXPECT_EQ(rows.rest, (std::vector<std::string>{",#1", ",#2", ",3"}));
  EXPECT_EQ(rows.numbers[2][0], 7);
  for (const char* line : {"# comment\n", "#, much, too, long\n", "#4, 8 # nine\n"}) {
    write_whole(file, std::string("name,a\n3,7\n") + line);
    try {
      const Catalogue refused(file, {"a"}, {}, {});
      ADD_FAILURE() << line;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("a.csv: line 3"), std::string::npos) << error.what();
    }
  }
}

// The first line is a row if no line names the columns; the second reading of the file begins with it, too.
TEST(Catalogue, NoHeader) {
  const TemporaryFolder folder;
  write_whole(folder / "a.csv", "\xEF\xBB\xBF# comment\n\n1,2\n3,4\n");
  Catalogue catalogue((folder / "a.csv").string(), {"a", "b"}, {"c"}, {});
  EXPECT_EQ(catalogue.rows(), 2);
  const CatalogueRows rows = catalogue.next({9});
  EXPECT_EQ(rows.line, (std::vector<std::size_t>{3, 4}));
  EXPECT_EQ(rows.numbers[1][1], 4);
}

// A portion ends with the row that makes it weigh enough, so that what is held at a time is bounded.
TEST(Catalogue, PortionsAreWeighed) {
  const tests::TemporaryFolder folder;
  write_whole(folder.path() / "a.csv", "a\n3\n4\n9\n1\n1\n");
  Catalogue catalogue((folder.path() / "a.csv").string(), {"a"}, {}, {});
  catalogue.weigh_by([](const std::vector<double>& row) { return row[0]; });
  for (const std::size_t rows : {2U, 1U, 2U, 0U}) EXPECT_EQ(catalogue.next({5}).line.size(), rows);
  // Heavy rows, too, are several, up to a weight at which they are too much.
  Catalogue heavy((folder.path() / "a.csv").string(), {"a"}, {}, {});
  heavy.weigh_by([](const std::vector<double>& row) { return 10 * row[0]; });
  for (const std::size_t rows : {3U, 2U, 0U})
    EXPECT_EQ(heavy.next({.weight = 5, .rows = 4, .most = 150}).line.size(), rows);
  EXPECT_EQ(portion_for(100, 3).rows, 48U);
}

// Lines across the portions in which a file is read.
TEST(Catalogue, LongFiles) {
  const TemporaryFolder folder;
  std::string text = "a,note\n";
  for (int i = 0; i < 5000; ++i)
    text += std::to_string(i) + "," + std::string(static_cast<std::size_t>(i % 997), 'n') + "\n";
  write_whole(folder.path() / "a.csv", text);
  Catalogue a((folder.path() / "a.csv").string(), {"a"}, {}, {});
  (void)a.next({4000});
  const CatalogueRows rows = a.next({900});
  EXPECT_EQ(rows.first, 4001);
  ASSERT_EQ(rows.line.size(), 900U);
  EXPECT_EQ(rows.numbers[899][0], 4899);
}

TEST(LinesInThreads, AreInOrder) {
  for (const std::size_t count : {0U, 1U, 63U, 1000U}) {
    std::string expected;
    for (std::size_t i = 0; i < count; ++i) expected += std::to_string(i) + '\n';
    for (const int threads : {0, 1, 3}) {
      EXPECT_EQ(
          lines_in_threads(count, threads,
                           [](std::size_t i, std::string& lines) { lines += std::to_string(i) + '\n'; }),
          expected);
    }
  }
  const auto fails = [](std::size_t i, std::string&) {
    if (i == 500) throw InputError("no");
  };
  EXPECT_THROW((void)lines_in_threads(1000, 3, fails), InputError);
}

}  // namespace
}  // namespace nlmech::scene::catalogue_test

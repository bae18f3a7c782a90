#include "tools/error_words.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>

#include "engine/base/errors.h"

namespace ccdt {
namespace {

Place place() {
  Place place;
  place.file = "part.off";
  place.line = 12;
  return place;
}

TEST(ErrorWords, SayFileLineWhatAndRemedy) {
  EXPECT_EQ(tools::in_words(InputError("the index 9 is out of range", place(), "the file has 8 vertices")),
            "ccdt: part.off:12: the index 9 is out of range\n  the file has 8 vertices");
}

TEST(ErrorWords, NameFacetsAndGiveCoordinatesBitForBit) {
  Place crossing = place();
  crossing.line = 0;
  crossing.facets = {3, 7};
  crossing.points = {{0.1, 1.0 / 3, -2}};
  EXPECT_EQ(
      tools::in_words(InputError("two facets cross", crossing, "repair the surface")),
      "ccdt: part.off: two facets cross\n  facets 3, 7\n  at (0.1, 0.3333333333333333, -2)\n  repair the surface");
}

TEST(ErrorWords, TellTheOffsetInABinaryFile) {
  Place offset;
  offset.file = "part.stl";
  offset.byte = 84;
  EXPECT_EQ(tools::in_words(InputError("ends here", offset, "")), "ccdt: part.stl:byte 84: ends here");
}

TEST(ErrorWords, OfManyPlacesShowSomeAndTheNumberOfTheOthers) {
  Place many;
  for (int i = 0; i < 25; ++i) many.facets.push_back(i);
  EXPECT_NE(tools::in_words(InputError("open", many, "")).find("and 15 more"), std::string::npos);
}

TEST(ErrorWords, ExitCodesFollowTheKindOfError) {
  EXPECT_EQ(tools::exit_code_of(InputError("", {}, "")), tools::bad_input);
  EXPECT_EQ(tools::exit_code_of(OutputError("", {}, "")), tools::bad_input);
  EXPECT_EQ(tools::exit_code_of(LimitError("", {}, "")), tools::limit_reached);
  EXPECT_EQ(tools::exit_code_of(MeshError("", {}, "")), tools::failed_a_check);
  EXPECT_EQ(tools::exit_code_of(std::bad_alloc()), tools::limit_reached);
  EXPECT_EQ(tools::exit_code_of(std::filesystem::filesystem_error("", {})), tools::bad_input);
}

}  // namespace
}  // namespace ccdt

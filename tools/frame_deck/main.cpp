/// Makes the deck of reference values for frames, each by two routes:
///
///     frame_deck tables/frames/deck.csv        some seconds
#include <fmt/format.h>

#include <exception>

#include "nlmech/scene/program/files.hpp"
#include "tools/frame_deck/deck.hpp"

int main(int argc, char** argv) {
  try {
    if (argc != 2) {
      fmt::print(stderr, "frame_deck: give the file\n");
      return 2;
    }
    nlmech::scene::write_whole(argv[1], nlmech::frame_deck::deck());
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "frame_deck: {}\n", error.what());
    return 1;
  }
}

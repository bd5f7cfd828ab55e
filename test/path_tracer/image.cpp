// SPDX-License-Identifier: Apache-2.0
// Pictures written and read back, and files that appear whole or not at all.
#include "io/image.hpp"

#include <sys/stat.h>

#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>

#include "catch.hpp"
#include "io/output_file.hpp"
#include "path_tracer/fixture.hpp"
#include "path_tracer/png.hpp"

#if defined(PATH_TRACER_HAS_OPENEXR) && __has_include(<ImfInputFile.h>)
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#define TEST_OPENEXR
#endif

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

/// 3 x 2, no two values alike.
image gradient() {
  image result{3, 2, {}};
  for (int i = 0; i < 6; ++i) {
    float const v = static_cast<float>(i);
    result.pixels.push_back({v / 8, v * 1000 - 1, 1 / (v + 3)});
  }
  return result;
}

std::string reason(std::string const& path) {
  try {
    write_file(path, "bytes");
  } catch (std::runtime_error const& e) {
    return e.what();
  }
  return "";
}

TEST_CASE("PNG holds clamped sRGB, top row first") {
  temporary_folder const folder;
  float const nan = std::numeric_limits<float>::quiet_NaN();
  float const infinity = std::numeric_limits<float>::infinity();
  image const picture{2, 2, {{0, 0.5f, 1}, {-3, 7, nan}, {0.001f, 0.21586f, infinity}, {1, 0, 0}}};
  write_image(folder / "a.PNG", picture);
  png_picture const read = read_png(folder / "a.PNG");
  CHECK(read.width == 2);
  CHECK(read.height == 2);
  REQUIRE(read.channels == 3);
  CHECK(read.values == std::vector<int>{0, 188, 255, 0, 255, 0, 3, 128, 255, 255, 0, 0});
}

TEST_CASE("exposure makes a PNG brighter or darker by stops, and no other format") {
  temporary_folder const folder;
  image const picture{2, 1, {{0.25f, 0.21586f, 0}, {0.125f, 2, 0.001f}}};
  image const brighter{2, 1, {{0.5f, 0.43172f, 0}, {0.25f, 4, 0.002f}}};
  image const darker{2, 1, {{0.0625f, 0.053965f, 0}, {0.03125f, 0.5f, 0.00025f}}};
  for (auto const& [stops, same] : {std::pair{1.0f, brighter}, {-2.0f, darker}, {0.0f, picture}}) {
    CAPTURE(stops);
    write_image(folder / "a.png", picture, stops);
    write_image(folder / "b.png", same);
    CHECK(read_bytes(folder / "a.png") == read_bytes(folder / "b.png"));
  }
  for (std::string_view const ending : image_endings()) {
    if (ending == ".png") continue;
    std::string const name = folder / ("a" + std::string(ending));
    write_image(name, picture);
    std::string const before = read_bytes(name);
    write_image(name, picture, 3);
    CHECK(read_bytes(name) == before);
  }
}

TEST_CASE("PFM holds the floats as they are, bottom row first") {
  temporary_folder const folder;
  image const picture = gradient();
  write_image(folder / "a.pfm", picture);
  std::string const bytes = read_bytes(folder / "a.pfm");
  std::string const head = "PF\n3 2\n-1.0\n";
  REQUIRE(bytes.size() == head.size() + 72);
  CHECK(bytes.substr(0, head.size()) == head);
  std::vector<vec3> rows(6);
  std::memcpy(rows.data(), bytes.data() + head.size(),
              72);  // the tests run on little-endian machines
  for (std::size_t i = 0; i < 6; ++i) CHECK(rows[i] == picture.pixels[(i + 3) % 6]);
}

#ifdef TEST_OPENEXR
TEST_CASE("OpenEXR holds the floats as they are, top row first") {
  temporary_folder const folder;
  image const picture = gradient();
  std::string const path = folder / "a.exr";
  write_image(path, picture);
  Imf::InputFile file(path.c_str());
  CHECK(file.header().dataWindow().max.x == 2);
  CHECK(file.header().dataWindow().max.y == 1);
  std::vector<vec3> read(6);
  Imf::FrameBuffer pixels;
  char* const start = reinterpret_cast<char*>(read.data());
  char const* const names[] = {"R", "G", "B"};
  for (std::size_t i = 0; i < 3; ++i)
    pixels.insert(names[i], Imf::Slice(Imf::FLOAT, start + 4 * i, 12, 36));
  file.setFrameBuffer(pixels);
  file.readPixels(0, 1);
  CHECK(read == picture.pixels);
}
#endif

TEST_CASE("a picture of another ending is refused") {
  temporary_folder const folder;
  CHECK_THROWS_AS(write_image(folder / "a.jpg", gradient()), std::invalid_argument);
  CHECK(has_image_ending("a/b.Png"));
  CHECK(!has_image_ending("a.png/b"));
  CHECK(folder.names().empty());
}

TEST_CASE("a file takes the place of an older one, and nothing else stays") {
  temporary_folder const folder;
  std::string const path = folder / "file";
  write_file(path, "older, longer");
  write_file(path, "new");
  CHECK(read_bytes(path) == "new");
  check_writable(path);
  check_writable(folder / "none");
  CHECK(read_bytes(path) == "new");
  CHECK(folder.names() == std::vector<std::string>{"file"});
  struct stat status {};
  REQUIRE(::stat(path.c_str(), &status) == 0);
  mode_t const mask = ::umask(0);
  ::umask(mask);
  CHECK((status.st_mode & 0777u) == (0666u & ~mask));
}

TEST_CASE("a symbolic link stays one") {
  temporary_folder const folder;
  write_file(folder / "file", "older");
  std::filesystem::create_symlink("file", folder / "link");
  write_file(folder / "link", "new");
  CHECK(std::filesystem::is_symlink(folder / "link"));
  CHECK(read_bytes(folder / "file") == "new");
}

TEST_CASE("a file that cannot be written is named with the reason of the system") {
  temporary_folder const folder;
  write_file(folder / "file", "older");
  CHECK(reason("/dev/full") == "cannot write /dev/full: No space left on device");
  CHECK(reason(folder / "none/x") ==
        "cannot write " + (folder / "none/x") + ": No such file or directory");
  CHECK(reason(folder / "") == "cannot write " + (folder / "") + ": Is a directory");
  CHECK(reason(folder / "file/x") == "cannot write " + (folder / "file/x") + ": Not a directory");
  if (::geteuid() != 0) {  // root may write anywhere
    ::chmod((folder / "").c_str(), 0555);
    CHECK(reason(folder / "x") == "cannot write " + (folder / "x") + ": Permission denied");
    ::chmod((folder / "").c_str(), 0755);
  }
  CHECK(folder.names() == std::vector<std::string>{"file"});
  CHECK(read_bytes(folder / "file") == "older");
}

}  // namespace

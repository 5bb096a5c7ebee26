#include "conchoid/io/picture.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cmath>

#include "conchoid/core/context.hpp"
#include "conchoid/io/stroke_font.hpp"
#include "io/samples.hpp"

using namespace conchoid;

namespace {

const PictureSettings small{240, 160, Vec3(0.62, -1.0, 0.52), Vec3(0, 0, 1), 2, true, true, 0};

/// Pixels that are clearly orange in columns [from, to).
std::size_t warm_pixels(const Image& image, int from, int to) {
  std::size_t count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = from; x < to; ++x)
      count += image.pixel(x, y)[0] > image.pixel(x, y)[2] + 60;
  return count;
}

}  // namespace

TEST(Picture, PngDecodesToWhatWasRendered) {
  const TemporaryFolder folder;
  const std::vector<PicturePanel> panels{{exploded(broken_cube(0.1), 0.8), "two pieces", "", ""}};
  write_picture(folder / "p.png", panels, small);
  const Image expected = render_picture(panels, small);

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_file(&png, (folder / "p.png").c_str()));
  EXPECT_EQ(png.width, 240u);
  EXPECT_EQ(png.height, 160u);
  png.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  ASSERT_TRUE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr));
  EXPECT_EQ(pixels, expected.rgb);
}

TEST(Picture, FractureIsSeenOnlyWhenThePiecesAreApart) {
  const auto pieces = broken_cube(0.0);
  const Image together = render_picture({{exploded(pieces, 0), "", "", ""}}, small);
  const Image apart = render_picture({{exploded(pieces, 1), "", "", ""}}, small);
  EXPECT_EQ(warm_pixels(together, 0, 240), 0u);
  EXPECT_GT(warm_pixels(apart, 0, 240), 240u * 160u / 50);
}

TEST(Picture, PanelsStandSideBySide) {
  PictureMesh red;
  red.mesh = box({0, 0, 0}, {1, 1, 1});
  red.face_kind.assign(12, FaceKind::fracture);
  PictureMesh grey = red;
  grey.face_kind.clear();
  const Image image = render_picture({{{grey}, "left", "", ""}, {{red}, "right", "", ""}}, small);
  EXPECT_EQ(warm_pixels(image, 0, 120), 0u);
  EXPECT_GT(warm_pixels(image, 120, 240), 2000u);
}

TEST(Picture, PanelsStandInRowsOfAContactSheet) {
  PictureMesh red;
  red.mesh = box({0, 0, 0}, {1, 1, 1});
  red.face_kind.assign(12, FaceKind::fracture);
  PictureMesh grey = red;
  grey.face_kind.clear();
  PictureSettings grid = small;
  grid.columns = 2;
  const Image image = render_picture({{{grey}, "", "", ""}, {{grey}, "", "", ""}, {{red}, "", "", ""}}, grid);
  std::size_t below = 0;
  for (int y = 80; y < 160; ++y)
    for (int x = 0; x < 120; ++x)
      below += image.pixel(x, y)[0] > image.pixel(x, y)[2] + 60;
  EXPECT_GT(below, 1000u);
  EXPECT_EQ(warm_pixels(image, 0, 240), below);  // nowhere else
}

TEST(Picture, SameBitsForEveryThreadCountAndSizeOfTheWorld) {
  const auto panels = [](double scale, const Vec3& shift) {
    PictureMesh m;
    m.mesh = sheet(8, 0.3);
    for (Vec3& x : m.mesh.positions)
      x = scale * x + shift;
    for (std::size_t n = 0; n < m.mesh.node_count(); ++n)
      m.node_value.push_back(double(n));
    m.edges = true;
    return std::vector<PicturePanel>{{{m}, "sheet", "caption", "value"}};
  };
  const auto draw = [&](int threads, double scale, const Vec3& shift) {
    return ExecutionContext(threads).run([&] { return render_picture(panels(scale, shift), small); });
  };
  const Image one = draw(1, 1, Vec3::Zero());
  EXPECT_EQ(draw(2, 1, Vec3::Zero()).rgb, one.rgb);
  EXPECT_EQ(draw(2, 1024, Vec3::Zero()).rgb, one.rgb);
  const Image far = draw(2, 1, Vec3(1e6, -1e6, 1e6));
  std::size_t different = 0;
  for (std::size_t i = 0; i < one.rgb.size(); ++i)
    different += std::abs(int(one.rgb[i]) - int(far.rgb[i])) > 24;
  EXPECT_LT(different, one.rgb.size() / 200);
}

TEST(Picture, GhostLetsTheCrackThrough) {
  const auto meshes = crack_in_body(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), sheet(4, 0));
  EXPECT_GT(warm_pixels(render_picture({{meshes, "", "", ""}}, small), 0, 240), 1000u);
}

TEST(Picture, NothingToShowIsABlankPicture) {
  const Image none = render_picture({}, small), empty = render_picture({{{}, "", "", ""}}, small);
  EXPECT_EQ(*std::min_element(none.rgb.begin(), none.rgb.end()),
            *std::max_element(none.rgb.begin(), none.rgb.end()));
  EXPECT_GT(*std::min_element(empty.rgb.begin(), empty.rgb.end()), 200);
}

TEST(StrokeFont, TextCoversTheWidthItClaims) {
  Image image(400, 60);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{255});
  const TextStyle style{20, 0.13, {0, 0, 0}};
  const double width = text_width("K_I = 2 MPa·√m", style);
  draw_text(image, 10, 40, "K_I = 2 MPa·√m", style);
  int left = 400, right = 0;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 400; ++x)
      if (image.pixel(x, y)[0] < 128) {
        left = std::min(left, x);
        right = std::max(right, x);
      }
  EXPECT_NEAR(left, 10, 2);
  EXPECT_NEAR(right, 10 + width, 2);
  EXPECT_EQ(text_width("", style), 0);
  draw_text(image, -50, 500, "outside", style);  // nothing is written outside the image
}

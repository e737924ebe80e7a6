// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/render.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <limits>

namespace hyperex::render {
namespace {

// A ball of 10 cm about the origin.
TriMesh ball(int rings = 48) {
  const int around = 2 * rings;
  TriMesh mesh{Points((rings + 1) * around, 3), Triangles(2 * rings * around, 3)};
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < around; ++j) {
      const double polar = M_PI * i / rings, turn = 2 * M_PI * j / around;
      mesh.points.row(i * around + j) << 0.1 * std::sin(polar) * std::sin(turn),
          0.1 * std::cos(polar), 0.1 * std::sin(polar) * std::cos(turn);
    }
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < around; ++j) {
      const int next = (j + 1) % around, row = 2 * (i * around + j);
      mesh.triangles.row(row) << i * around + j, (i + 1) * around + j, (i + 1) * around + next;
      mesh.triangles.row(row + 1) << i * around + j, (i + 1) * around + next, i * around + next;
    }
  return mesh;
}

bool is_background(const Image& image, int x, int y) {
  const Image blank(1, 1);
  for (int k = 0; k < 3; ++k)
    if (image.pixel(x, y)[k] != blank.rgb[k]) return false;
  return true;
}

const RenderOptions square{.width_px = 200, .height_px = 200, .samples = 2};
const Camera front{.height_m = 0.4};

TEST(Render, CoversWhatTheCameraGeometrySays) {
  const TriMesh mesh = ball();
  const Image image = render({{.mesh = mesh}}, front, square);
  double covered = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) covered += !is_background(image, x, y);
  EXPECT_NEAR(covered, M_PI * 50 * 50, 250);  // a disc of 50 px and its half-covered rim
  EXPECT_TRUE(is_background(image, 100, 45));
  EXPECT_FALSE(is_background(image, 100, 53));
}

TEST(Render, PutsPointsWhereProjectSays) {
  // A small ball drawn alone must appear about the projection of its centre, from any side.
  for (const Vec3& view : {front_view(), three_quarter_view(), Vec3(-1, 0.4, 0.1)}) {
    TriMesh mesh = ball(12);
    const Vec3 centre(0.05, -0.06, 0.03);
    mesh.points = (0.1 * mesh.points).rowwise() + centre.transpose();
    const Camera camera{.target = {0.01, 0.02, 0}, .to_viewer = view, .height_m = 0.4};
    const Image image = render({{.mesh = mesh}}, camera, square);
    double sum_x = 0, sum_y = 0, count = 0;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        if (!is_background(image, x, y)) {
          sum_x += x + 0.5;
          sum_y += y + 0.5;
          ++count;
        }
    ASSERT_GT(count, 50);
    const Projected expected = project(camera, 200, 200, centre);
    EXPECT_NEAR(sum_x / count, expected.x, 0.3);
    EXPECT_NEAR(sum_y / count, expected.y, 0.3);
  }
}

TEST(Render, FrontViewHasTheSubjectsLeftOnTheRight) {
  const Projected left = project(front, 200, 200, Vec3(0.1, 0, 0));
  const Projected up = project(front, 200, 200, Vec3(0, 0.1, 0));
  EXPECT_NEAR(left.x, 150, 1e-9);
  EXPECT_NEAR(up.y, 50, 1e-9);
  EXPECT_NEAR(project(front, 200, 200, Vec3(0, 0, 0.1)).towards_viewer_m, 0.1, 1e-12);
}

TEST(Render, TheNearerSurfaceIsSeen) {
  const TriMesh mesh = ball();
  TriMesh nearer = mesh;
  nearer.points.col(2).array() += 0.05;
  const Surface red{.mesh = mesh, .plain = {1, 0, 0}};
  const Surface green{.mesh = nearer, .plain = {0, 1, 0}};
  for (const auto& both : {std::vector{red, green}, std::vector{green, red}}) {
    const Image image = render(both, front, square);
    EXPECT_GT(image.pixel(100, 100)[1], 100);
    EXPECT_LT(image.pixel(100, 100)[0], 80);  // the sheen is white
  }
}

TEST(Render, ScalarsGoThroughTheMapAndNaNIsPlain) {
  const TriMesh mesh = ball();
  Eigen::VectorXf height = mesh.points.col(1).cast<float>();
  const auto hue = [&](const Eigen::VectorXf& scalar, int y) {
    const Image image =
        render({{.mesh = mesh, .scalar = scalar, .range = {-0.1, 0.1}, .plain = {1, 1, 1}}}, front,
               square);
    const std::uint8_t* p = image.pixel(100, y);
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  const auto top = hue(height, 60), bottom = hue(height, 140);
  EXPECT_GT(top[1], 3 * top[0] / 2);  // dark green at the top
  EXPECT_GT(bottom[0], 2 * top[0]);   // pale at the bottom, where the lamps shine less
  EXPECT_GT(bottom[0], bottom[2]);
  height.setConstant(std::numeric_limits<float>::quiet_NaN());
  const auto plain = hue(height, 100);
  EXPECT_EQ(plain[0], plain[1]);
  EXPECT_EQ(plain[1], plain[2]);
}

TEST(Render, MarkersAndLinesShowOnlyWhereNothingHidesThem) {
  const TriMesh mesh = ball();
  const Surface surface{.mesh = mesh, .plain = {0.5, 0.5, 0.5}};
  const Colour red{1, 0, 0};
  const auto reds = [&](const Image& image) {
    int count = 0;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        count += image.pixel(x, y)[0] > 200 && image.pixel(x, y)[1] < 80;
    return count;
  };
  EXPECT_GT(reds(render({surface}, front, square, {{{0, 0, 0.1}, red, 5}})), 60);
  EXPECT_EQ(reds(render({surface}, front, square, {{{0, 0, -0.1}, red, 5}})), 0);
  const Image behind = render({surface}, front, square, {{{0, 0, 0.097}, red, 5}});
  EXPECT_GT(reds(behind), 30) << "3 mm behind the surface: drawn hollow";
  EXPECT_GT(behind.pixel(100, 100)[1], 200);
  Points line(2, 3);
  line << -0.15, 0, 0, 0.15, 0, 0;  // through the ball: only its ends stand out
  const int outside = reds(render({surface}, front, square, {}, {{line, red, 2}}));
  EXPECT_NEAR(outside, 2 * 25 * 2, 30);
  line.col(2).setConstant(0.12);
  EXPECT_NEAR(reds(render({surface}, front, square, {}, {{line, red, 2}})), 150 * 2, 40);
}

TEST(Render, AFanIsTranslucentWithoutSeamsAndHiddenBehindASurface) {
  const TriMesh mesh = ball();
  const auto drawn = [&](const Fan& fan) {
    return render({{.mesh = mesh}}, front, square, {}, {}, {fan});
  };
  const Image without = render({{.mesh = mesh}}, front, square);
  Fan fan{.points = Points(4, 3), .colour = {1, 0, 0}, .opacity = 0.5};
  // Beside the ball: the tip at pixel 155, 10, the others 30 pixels below.
  fan.points << 0.11, 0.18, 0, 0.11, 0.12, 0, 0.15, 0.12, 0, 0.19, 0.12, 0;
  const Image beside = drawn(fan);
  for (int x = 157; x < 186; ++x)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(beside.pixel(x, 36)[k], 0.5 * without.pixel(x, 36)[k] + (k == 0 ? 127.5 : 0), 2)
          << x;
  EXPECT_EQ(beside.pixel(150, 36)[1], without.pixel(150, 36)[1]) << "outside";
  EXPECT_EQ(beside.pixel(185, 20)[1], without.pixel(185, 20)[1]) << "it is narrow at its tip";
  const auto before_or_behind = [&](double z) {
    fan.points << 0, 0.03, z, -0.02, -0.03, z, 0, -0.03, z, 0.02, -0.03, z;
    return drawn(fan).rgb == without.rgb;
  };
  EXPECT_TRUE(before_or_behind(-0.2));
  EXPECT_FALSE(before_or_behind(0.2));
  fan.points.conservativeResize(2, 3);
  EXPECT_EQ(drawn(fan).rgb, without.rgb) << "no triangle";
}

TEST(Render, BackFacesAreDarker) {
  TriMesh mesh = ball();
  const Image outside = render({{.mesh = mesh}}, front, square);
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  const Image inside = render({{.mesh = mesh}}, front, square);
  EXPECT_LT(inside.pixel(100, 100)[0], 0.8 * outside.pixel(100, 100)[0]);
}

TEST(Render, IsTheSameForAnyNumberOfThreads) {
  const TriMesh mesh = ball();
  const Surface surface{
      .mesh = mesh, .scalar = mesh.points.col(1).cast<float>(), .range = {0, 0.1}};
  const Image many = render({surface}, front, square);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(render({surface}, front, square).rgb, many.rgb);
}

/// An irregular quadrilateral in the plane z = 0, with colours that increase along x and y.
TEST(Render, IsWhatSingleRaysThroughTheSamplesMeet) {
  TriMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.points << -0.11, -0.09, 0, 0.12, -0.13, 0, 0.08, 0.14, 0, -0.13, 0.1, 0;
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  VertexColours colours(4, 3);
  colours << 20, 200, 128, 250, 180, 128, 240, 10, 128, 10, 30, 128;
  const Camera camera{.target = {0.003, -0.002, 0}, .to_viewer = {0.2, 0.1, 1}, .height_m = 0.31};
  constexpr int size = 61, n = 2;
  const RenderOptions options{.width_px = size, .height_px = size, .samples = n};
  const Image image = render({{.mesh = mesh, .colours = colours}}, camera, options);

  // Flat, so that the light is one factor and one addend of the colour: those of black and white.
  const auto light_of = [&](double grey) {
    return linear_from_srgb(render({{.mesh = mesh, .plain = {grey, grey, grey}}}, camera, options)
                                .pixel(size / 2, size / 2)[0] /
                            255.0);
  };
  const double sheen = light_of(0), lit = light_of(0.5) - sheen;
  Eigen::MatrixX2d places(size * size * n * n, 2);
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    places.row(i) << (double(i % (size * n)) + 0.5) / n, (double(i / (size * n)) + 0.5) / n;
  const auto rays = pick({{.mesh = mesh}}, camera, size, size, places);
  const double grey = linear_from_srgb(0.5), behind = linear_from_srgb(options.background.r);
  int others = 0, met = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double light = 0;
      for (int k = 0; k < n * n; ++k) {
        const auto& ray = rays[std::size_t((y * n + k / n) * size * n + x * n + k % n)];
        if (!ray) light += behind;
        if (!ray) continue;
        double colour = 0;
        for (int c = 0; c < 3; ++c)
          colour += ray->weights[c] *
                    linear_from_srgb(colours(mesh.triangles(ray->triangle, c), 0) / 255.0);
        light += sheen + lit * colour / grey;
        ++met;
      }
      const double expected = 255 * srgb_from_linear(std::min(1.0, light / (n * n)));
      others += std::abs(image.pixel(x, y)[0] - expected) > 2;  // light_of is of whole bytes
    }
  EXPECT_GT(met, size * size);
  EXPECT_LE(others, 2) << "on an edge, by rounding";
}

TEST(Render, FramingHoldsEveryPoint) {
  const TriMesh mesh = ball();
  for (const double aspect : {0.5, 1.0, 2.0}) {
    const Camera camera = framing(mesh.points, three_quarter_view(), aspect);
    const int height = 300, width = static_cast<int>(height * aspect);
    double least = 1e9;
    for (int i = 0; i < mesh.points.rows(); ++i) {
      const Projected p = project(camera, width, height, mesh.points.row(i));
      least = std::min({least, p.x, p.y, width - p.x, height - p.y});
    }
    EXPECT_GT(least, 0);
    EXPECT_LT(least, 0.08 * height);
  }
}

TEST(Render, BacksAreHiddenWhereAsked) {
  TriMesh mesh = ball(12);
  RenderOptions hiding = square;
  hiding.hide_backs = true;
  EXPECT_FALSE(is_background(render({{.mesh = mesh}}, front, hiding), 100, 100));
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  EXPECT_FALSE(is_background(render({{.mesh = mesh}}, front, square), 100, 100));
  EXPECT_TRUE(is_background(render({{.mesh = mesh}}, front, hiding), 100, 100));
}

TEST(Pick, IsWhatProjectUndoes) {
  const TriMesh mesh = ball();
  const Camera camera{
      .target = {0.01, 0.02, 0}, .to_viewer = three_quarter_view(), .height_m = 0.4};
  Eigen::MatrixX2d places(3, 2);
  places << 90.25, 80.5, 120, 110, 3, 3;
  const auto picked = pick({{.mesh = mesh}}, camera, 200, 200, places);
  ASSERT_EQ(picked.size(), 3u);
  EXPECT_FALSE(picked[2]);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(picked[i]);
    EXPECT_EQ(picked[i]->surface, 0);
    const Projected p = project(camera, 200, 200, picked[i]->point);
    EXPECT_NEAR(p.x, places(i, 0), 1e-3);
    EXPECT_NEAR(p.y, places(i, 1), 1e-3);
    EXPECT_NEAR(picked[i]->point.norm(), 0.1, 2e-4);  // on the ball, its near side
    EXPECT_NEAR(picked[i]->facing, picked[i]->point.normalized().dot(camera.to_viewer.normalized()),
                0.05);
    EXPECT_NEAR(picked[i]->weights.sum(), 1, 1e-6);
  }
}

TEST(Render, RefusesSizesThatDisagree) {
  const TriMesh mesh = ball(6);
  EXPECT_THROW(render({{.mesh = mesh, .scalar = Eigen::VectorXf::Zero(3)}}, front, square),
               std::invalid_argument);
  EXPECT_THROW(render({{.mesh = mesh}}, front, {.width_px = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::render

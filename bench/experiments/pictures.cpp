// SPDX-License-Identifier: GPL-3.0-or-later
#include "experiments/pictures.hpp"

#include <turbojpeg.h>

#include <memory>
#include <stdexcept>

#include "hyperex/core/files.hpp"

namespace hyperex::bench {

FacePictures::FacePictures(const Study& study) : frame_(study.frame()) {
  widened_ = study.embedded() ? 1.15 : 1.3;  // the head extends beyond the landmarks
  const io::Landmarks& landmarks = study.inputs().landmarks;
  framed_.resize(Eigen::Index(landmarks.size()), 3);
  Eigen::Index row = 0;
  for (const auto& [name, at] : landmarks) framed_.row(row++) = frame_.local(at).transpose();
}

render::Image FacePictures::draw(const std::vector<Layer>& layers, const Vec3& view, int width_px,
                                 int height_px, const std::vector<render::Marker>& markers) const {
  render::Camera camera = render::framing(framed_, view, double(width_px) / height_px);
  camera.height_m *= widened_;
  return draw(layers, camera, width_px, height_px, markers);
}

render::Image FacePictures::draw_mouth(const std::vector<Layer>& layers, int width_px,
                                       int height_px,
                                       const std::vector<render::Marker>& markers) const {
  // The frame's origin lies between the corners of the mouth.
  const render::Camera camera{
      .target = {0, 0.018, 0}, .to_viewer = render::front_view(), .height_m = 0.11};
  return draw(layers, camera, width_px, height_px, markers);
}

render::Image FacePictures::draw(const std::vector<Layer>& layers, const render::Camera& camera,
                                 int width_px, int height_px,
                                 const std::vector<render::Marker>& markers) const {
  std::vector<TriMesh> meshes;
  for (const Layer& layer : layers) {
    Points points = layer.mesh.points;
    for (Eigen::Index v = 0; v < points.rows(); ++v)
      points.row(v) = frame_.local(points.row(v)).transpose();
    meshes.push_back({std::move(points), layer.mesh.triangles});
  }
  std::vector<render::Surface> surfaces;
  for (std::size_t i = 0; i < layers.size(); ++i)
    surfaces.push_back({.mesh = meshes[i],
                        .scalar = layers[i].scalar,
                        .range = layers[i].range,
                        .plain = layers[i].plain});
  return render::render(surfaces, camera, {.width_px = width_px, .height_px = height_px}, markers);
}

render::Marker FacePictures::marker(const Vec3& at, const render::Colour& colour) const {
  return {frame_.local(at), colour, 3.5};
}

TriMesh moved_skin(const simulate::Performance& p, const PointsF& displacement) {
  return {p.skin_rest.points + displacement.cast<double>(), p.skin_rest.triangles};
}

void write_jpeg(const std::filesystem::path& file, const render::Image& image) {
  constexpr int quality = 88;
  const std::unique_ptr<void, int (*)(tjhandle)> handle(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  if (!handle || tjCompress2(handle.get(), image.rgb.data(), image.width, 0, image.height, TJPF_RGB,
                             &bytes, &size, TJSAMP_444, quality, 0) != 0)
    throw std::runtime_error("no JPEG: " + std::string(tjGetErrorStr2(handle.get())));
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> held(bytes, tjFree);
  write_file_atomically(file, [&](std::ostream& out) {
    out.write(reinterpret_cast<const char*>(bytes), std::streamsize(size));
  });
}

}  // namespace hyperex::bench

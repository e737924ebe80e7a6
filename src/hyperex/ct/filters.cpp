// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/filters.hpp"

#include <itkConnectedComponentImageFilter.h>
#include <itkImage.h>
#include <itkMorphologicalWatershedFromMarkersImageFilter.h>
#include <itkRelabelComponentImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>

namespace hyperex::ct {
namespace {

using ByteImage = itk::Image<std::uint8_t, 3>;
using NumberImage = itk::Image<std::uint32_t, 3>;
using FloatImage = itk::Image<float, 3>;

/// An image that refers to `mask`, which must outlive it.
ByteImage::Pointer image_of(const Mask& mask, const Grid& grid) {
  auto image = ByteImage::New();
  ByteImage::SizeType size;
  for (unsigned a = 0; a < 3; ++a) size[a] = itk::SizeValueType(grid.size[a]);
  image->SetRegions(size);
  // ITK warns of spacings below 1e-3, so lengths are in millimetres here.
  ByteImage::SpacingType spacing;
  for (unsigned a = 0; a < 3; ++a) spacing[a] = grid.spacing_m[a] * 1e3;
  image->SetSpacing(spacing);
  image->GetPixelContainer()->SetImportPointer(const_cast<std::uint8_t*>(mask.data()), mask.size(),
                                               false);
  return image;
}

}  // namespace

Grid grid_of(const Volume& volume) {
  return {volume.size, volume.spacing_m()};
}

Pieces pieces_of(const Mask& mask, const Grid& grid, bool corners) {
  auto filter = itk::ConnectedComponentImageFilter<ByteImage, NumberImage>::New();
  filter->SetInput(image_of(mask, grid));
  filter->SetFullyConnected(corners);
  auto sorted = itk::RelabelComponentImageFilter<NumberImage, NumberImage>::New();
  sorted->SetInput(filter->GetOutput());
  sorted->Update();
  Pieces out;
  const std::uint32_t* from = sorted->GetOutput()->GetBufferPointer();
  out.number.assign(from, from + mask.size());
  out.count.assign(1, 0);
  for (const auto size : sorted->GetSizeOfObjectsInPixels()) out.count.push_back(size);
  return out;
}

std::vector<float> distance_to(const Mask& mask, const Grid& grid) {
  auto filter = itk::SignedMaurerDistanceMapImageFilter<ByteImage, FloatImage>::New();
  filter->SetInput(image_of(mask, grid));
  filter->SetBackgroundValue(0);
  filter->SetSquaredDistance(false);
  filter->SetUseImageSpacing(true);
  filter->SetInsideIsPositive(false);
  filter->Update();
  const float* from = filter->GetOutput()->GetBufferPointer();
  std::vector<float> out(from, from + mask.size());
  // ITK counts from the mask's outermost values, and negative ones within.
  for (float& d : out) d = std::max(0.0F, d) * 1e-3F;
  return out;
}

Mask watershed(const Mask& level, const Mask& markers, const Grid& grid) {
  auto filter = itk::MorphologicalWatershedFromMarkersImageFilter<ByteImage, ByteImage>::New();
  filter->SetInput1(image_of(level, grid));
  filter->SetInput2(image_of(markers, grid));
  filter->SetMarkWatershedLine(false);
  filter->SetFullyConnected(false);
  filter->Update();
  const std::uint8_t* from = filter->GetOutput()->GetBufferPointer();
  return {from, from + level.size()};
}

}  // namespace hyperex::ct

// SPDX-License-Identifier: GPL-3.0-or-later
// hx_itk.so: ITK's filters and readers, and GDCM (itk_library.hpp).
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkImage.h>
#include <itkImageFileReader.h>
#include <itkMorphologicalWatershedFromMarkersImageFilter.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <itkRelabelComponentImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <new>
#include <sstream>
#include <stdexcept>

#include "hyperex/ct/itk_library.hpp"

namespace hyperex::ct {
namespace {

using Bytes = std::vector<std::uint8_t>;
using ByteImage = itk::Image<std::uint8_t, 3>;
using NumberImage = itk::Image<std::uint32_t, 3>;
using FloatImage = itk::Image<float, 3>;

/// An image that refers to `mask`, which must outlive it.
ByteImage::Pointer image_of(const Bytes& mask, const ItkGrid& grid) {
  auto image = ByteImage::New();
  ByteImage::SizeType size;
  ByteImage::SpacingType spacing;
  for (unsigned a = 0; a < 3; ++a) {
    size[a] = itk::SizeValueType(grid.size[a]);
    spacing[a] = grid.spacing_mm[a];
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->GetPixelContainer()->SetImportPointer(const_cast<std::uint8_t*>(mask.data()), mask.size(),
                                               false);
  return image;
}

/// Computes the output of a filter. ITK's own errors have several lines, and the commonest is that
/// there was no memory for an image.
void update(itk::ProcessObject& filter) {
  try {
    filter.Update();
  } catch (const itk::MemoryAllocationError&) {
    throw std::bad_alloc();
  } catch (const itk::ExceptionObject&) {
    throw std::runtime_error("a filter of ITK failed on the CT's values");
  }
}

class Module final : public ItkLibrary {
 public:
  /// Both write remarks of their own, which may hold names, to standard error.
  Module() {
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
    itk::Object::GlobalWarningDisplayOff();
  }

  std::optional<DicomValues> values_of(const std::string& bytes,
                                       const std::vector<DicomTag>& tags) const override {
    gdcm::Reader reader;
    std::istringstream stream(bytes);
    reader.SetStream(stream);
    try {
      if (!reader.Read()) return std::nullopt;
    } catch (const std::exception&) {
      return std::nullopt;
    }
    DicomValues out;
    out.compressed = reader.GetFile().GetHeader().GetDataSetTransferSyntax().IsEncapsulated();
    const gdcm::DataSet& data = reader.GetFile().GetDataSet();
    const auto held_at = [&](const gdcm::Tag& tag) {
      return data.FindDataElement(tag) ? data.GetDataElement(tag).GetByteValue() : nullptr;
    };
    for (const DicomTag& tag : tags) {
      const gdcm::ByteValue* held = held_at(gdcm::Tag(tag.first, tag.second));
      out.values.emplace_back(held == nullptr ? ""
                                              : std::string(held->GetPointer(), held->GetLength()));
    }
    const gdcm::Tag picture(0x7fe0, 0x0010);
    out.has_picture = data.FindDataElement(picture);
    if (const gdcm::ByteValue* held = held_at(picture)) out.picture_bytes = held->GetLength();
    return out;
  }

  std::optional<DicomPixels> pixels_of(const std::string& bytes) const override {
    gdcm::ImageReader reader;
    std::istringstream stream(bytes);
    reader.SetStream(stream);
    try {
      if (!reader.Read()) return std::nullopt;
      const gdcm::Image& image = reader.GetImage();
      const gdcm::PixelFormat& format = image.GetPixelFormat();
      DicomPixels out;
      out.columns = int(image.GetDimension(0)), out.rows = int(image.GetDimension(1));
      out.is_signed = format.GetPixelRepresentation() == 1;
      out.slope = image.GetSlope(), out.intercept = image.GetIntercept();
      out.bytes.resize(image.GetBufferLength());
      const bool as_expected = format.GetSamplesPerPixel() == 1 &&
                               format.GetBitsAllocated() == 16 &&
                               out.bytes.size() == std::size_t(2) * out.columns * out.rows;
      if (!as_expected || !image.GetBuffer(out.bytes.data())) return std::nullopt;
      return out;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception&) {
      return std::nullopt;
    }
  }

  std::optional<ItkVolume> read_volume(const std::string& file, bool nifti) const override {
    auto reader = itk::ImageFileReader<FloatImage>::New();
    reader->SetFileName(file);
    if (nifti)
      reader->SetImageIO(itk::NiftiImageIO::New());
    else
      reader->SetImageIO(itk::NrrdImageIO::New());
    try {
      reader->Update();
    } catch (const std::exception&) {
      return std::nullopt;
    }
    const FloatImage& image = *reader->GetOutput();
    ItkVolume out;
    out.dimensions = int(reader->GetImageIO()->GetNumberOfDimensions());
    out.components = int(reader->GetImageIO()->GetNumberOfComponents());
    std::size_t count = 1;
    for (unsigned a = 0; a < 3; ++a) {
      out.grid.size[a] = int(image.GetLargestPossibleRegion().GetSize()[a]);
      out.grid.spacing_mm[a] = image.GetSpacing()[a];
      out.origin_mm[a] = image.GetOrigin()[a];
      for (unsigned r = 0; r < 3; ++r) out.direction[r][a] = image.GetDirection()[r][a];
      count *= std::size_t(out.grid.size[a]);
    }
    out.values.assign(image.GetBufferPointer(), image.GetBufferPointer() + count);
    return out;
  }

  void pieces(const Bytes& mask, const ItkGrid& grid, bool corners, std::vector<int>& number,
              std::vector<std::size_t>& count) const override {
    auto filter = itk::ConnectedComponentImageFilter<ByteImage, NumberImage>::New();
    filter->SetInput(image_of(mask, grid));
    filter->SetFullyConnected(corners);
    auto sorted = itk::RelabelComponentImageFilter<NumberImage, NumberImage>::New();
    sorted->SetInput(filter->GetOutput());
    update(*sorted);
    const std::uint32_t* from = sorted->GetOutput()->GetBufferPointer();
    number.assign(from, from + mask.size());
    count.assign(1, 0);
    for (const auto size : sorted->GetSizeOfObjectsInPixels()) count.push_back(size);
  }

  std::vector<float> signed_distance_mm(const Bytes& mask, const ItkGrid& grid) const override {
    auto filter = itk::SignedMaurerDistanceMapImageFilter<ByteImage, FloatImage>::New();
    filter->SetInput(image_of(mask, grid));
    filter->SetBackgroundValue(0);
    filter->SetSquaredDistance(false);
    filter->SetUseImageSpacing(true);
    filter->SetInsideIsPositive(false);
    update(*filter);
    const float* from = filter->GetOutput()->GetBufferPointer();
    return {from, from + mask.size()};
  }

  Bytes watershed(const Bytes& level, const Bytes& markers, const ItkGrid& grid) const override {
    auto filter = itk::MorphologicalWatershedFromMarkersImageFilter<ByteImage, ByteImage>::New();
    filter->SetInput1(image_of(level, grid));
    filter->SetInput2(image_of(markers, grid));
    filter->SetMarkWatershedLine(false);
    filter->SetFullyConnected(false);
    update(*filter);
    const std::uint8_t* from = filter->GetOutput()->GetBufferPointer();
    return {from, from + level.size()};
  }
};

}  // namespace
}  // namespace hyperex::ct

extern "C" __attribute__((visibility("default"))) const hyperex::ct::ItkLibrary* hyperex_itk() {
  static const hyperex::ct::Module module;
  return &module;
}

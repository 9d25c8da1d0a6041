#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <span>

#include "base/error.hpp"
#include "base/images/codec.hpp"
#include "base/images/exr_check.hpp"
#include "base/images/image_file.hpp"
#include "base/images/png_check.hpp"
#include "base/read_file.hpp"

namespace fastsplat::images {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 34;  // 2^31 float values and some

// The format by its magic number: extensions lie, and trying every reader on hostile bytes only adds risk.
const char* format_of(std::span<const unsigned char> bytes) {
  struct Magic {
    const char* format;
    std::array<unsigned char, 4> bytes;
  };
  static constexpr std::array<unsigned char, 3> kJpeg{0xff, 0xd8, 0xff};  // three bytes, whatever follows
  if (bytes.size() >= 3 && std::equal(kJpeg.begin(), kJpeg.end(), bytes.begin())) return "jpeg";
  static constexpr std::array<Magic, 6> kMagic{{{"openexr", {0x76, 0x2f, 0x31, 0x01}},
                                                {"png", {0x89, 'P', 'N', 'G'}},
                                                {"tiff", {'I', 'I', 42, 0}},
                                                {"tiff", {'M', 'M', 0, 42}},
                                                {"tiff", {'I', 'I', 43, 0}},
                                                {"tiff", {'M', 'M', 0, 43}}}};
  for (const auto& magic : kMagic) {
    if (bytes.size() >= 4 && std::equal(magic.bytes.begin(), magic.bytes.end(), bytes.begin())) return magic.format;
  }
  return nullptr;
}

}  // namespace

LoadedImage read_image(const std::filesystem::path& path) {
  const auto refuse = [&path](ErrorParts parts) {
    parts.where = path.string();
    throw_input(std::move(parts));
  };
  LoadedImage loaded;
  try {
    const std::string file = read_text_file(path, kLargestFile);
    const std::span bytes(reinterpret_cast<const unsigned char*>(file.data()), file.size());
    const char* format = format_of(bytes);
    if (format == nullptr) {
      refuse({{}, "not an image", "EXR, PNG, TIFF or JPEG", {}, "name an image file, or write it again"});
    }
    const bool png = std::strcmp(format, "png") == 0;
    if (png || std::strcmp(format, "openexr") == 0) {
      const std::string defect = png ? png_defect(bytes) : exr_defect(bytes);
      if (!defect.empty())
        refuse({{},
                std::string("corrupt or truncated ") + (png ? "PNG: " : "EXR: ") + defect,
                {},
                {},
                "write the file again"});
    }
    // The decoder fills up with grey what a cut file lacks.
    if (std::strcmp(format, "jpeg") == 0 && file.rfind("\xff\xd9") == std::string::npos)
      refuse({{}, "corrupt or truncated JPEG: its end is missing", {}, {}, "write the file again"});
    if (auto refusal = codec().decode(format, file, loaded)) refuse(std::move(*refusal));
    loaded.format = format;
  } catch (const std::bad_alloc&) {
    refuse({{}, "not enough memory to decode", {}, {}, {}});
  }
  return loaded;
}

const char* to_string(PixelKind kind) {
  switch (kind) {
    case PixelKind::Float:
      return "float";
    case PixelKind::Half:
      return "half";
    case PixelKind::Uint8:
      return "uint8";
    case PixelKind::Uint16:
      return "uint16";
    case PixelKind::RawWords:
      return "raw words";
  }
  return "";
}

}  // namespace fastsplat::images

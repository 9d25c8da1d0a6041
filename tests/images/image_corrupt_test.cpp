// SPDX-License-Identifier: Apache-2.0
// Damaged files load whole or are refused in one line; nothing crashes, nothing is printed, no memory is wasted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <random>

#include "base/images/image_file.hpp"
#include "tests/images/image_helper.hpp"

namespace fastsplat::images {
namespace {

using testing::HasSubstr;

struct Corrupt {
  const char* name;
  PixelKind kind;
  bool checksummed;  ///< every changed pixel byte must be noticed
};

// All formats in one test: every test is a process that has to load the image library.
constexpr std::array kCases{Corrupt{"f.exr", PixelKind::Float, false},    Corrupt{"h.exr", PixelKind::Half, false},
                            Corrupt{"w.exr", PixelKind::RawWords, false}, Corrupt{"8.png", PixelKind::Uint8, true},
                            Corrupt{"16.png", PixelKind::Uint16, true},   Corrupt{"8.tif", PixelKind::Uint8, false},
                            Corrupt{"16.tif", PixelKind::Uint16, false},  Corrupt{"f.tif", PixelKind::Float, false}};

Image smooth_image() {
  Image image(37, 23, 4);
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      for (int c = 0; c < 4; ++c) image.pixel(x, y)[c] = static_cast<float>((x / 37.0 + y / 23.0 + c / 4.0) / 3);
    }
  }
  return image;
}

void write(const std::filesystem::path& path, PixelKind kind) {
  const Image image = smooth_image();
  if (kind != PixelKind::RawWords) {
    write_image(path, image, {{"engine", "golden"}}, {.kind = kind});
    return;
  }
  std::vector<std::uint32_t> words;
  for (const float value : image.data) words.push_back(static_cast<std::uint32_t>(value * 65536));
  write_raw(path, {.width = 37, .height = 23, .int_bits = 1, .frac_bits = 16, .words = words, .config_hash = 1}, {});
}

enum class Outcome { Same, Different, Refused };

/// A valid file and the result of reading its damaged copies.
class Specimen {
 public:
  explicit Specimen(const Corrupt& format) : format_(format) {
    write(folder_ / format.name, format.kind);
    whole_ = file_text(folder_ / format.name);
    image_ = read_image(folder_ / format.name).image;
  }

  const std::string& whole() const { return whole_; }

  Outcome read(const std::string& bytes) const {
    const auto path = folder_ / (std::string("damaged_") + format_.name);
    write_bytes(path, bytes);
    try {
      const Image image = read_image(path).image;
      return image == image_ ? Outcome::Same : Outcome::Different;
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return Outcome::Refused;
    }
  }

 private:
  Corrupt format_;
  TempFolder folder_;
  std::string whole_;
  Image image_;
};

TEST(DamagedImage, TruncatedAnywhereIsRefused) {
  for (const Corrupt& format : kCases) {
    const Specimen specimen(format);
    const std::string& whole = specimen.whole();
    testing::internal::CaptureStderr();
    int refused = 0, accepted = 0;
    for (std::size_t size = 0; size < whole.size(); size += (size < 400 || size + 100 > whole.size()) ? 1 : 13) {
      (specimen.read(whole.substr(0, size)) == Outcome::Refused ? refused : accepted) += 1;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    std::printf("[figure] %s truncated: refused = %d, accepted = %d (limit 0)\n", format.name, refused, accepted);
    EXPECT_GT(refused, 300);
    EXPECT_EQ(accepted, 0);
  }
}

TEST(DamagedImage, OneByteChangedLoadsWholeOrIsRefused) {
  for (const Corrupt& format : kCases) {
    const Specimen specimen(format);
    std::mt19937 generator(2026);
    testing::internal::CaptureStderr();
    int refused = 0, same = 0, different = 0;
    for (int trial = 0; trial < 500; ++trial) {
      std::string bytes = specimen.whole();
      const std::size_t reach = trial % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 600);
      bytes[generator() % reach] = static_cast<char>(generator());
      const Outcome outcome = specimen.read(bytes);
      refused += outcome == Outcome::Refused;
      same += outcome == Outcome::Same;
      different += outcome == Outcome::Different;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    std::printf("[figure] %s one byte changed: refused = %d, unharmed = %d, other values = %d\n", format.name, refused,
                same, different);
    EXPECT_GT(refused, 250);
    if (format.checksummed) {
      EXPECT_EQ(different, 0);
    }
  }
}

long peak_resident_mib() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long kib = 0;
    if (word == "VmHWM:" && status >> kib) return kib / 1024;
  }
  ADD_FAILURE() << "no VmHWM in /proc/self/status";
  return 0;
}

TEST(DamagedImage, SizeThatLiesCostsNoMemory) {
  const TempFolder folder;
  write(folder / "a.exr", PixelKind::Float);
  std::string bytes = file_text(folder / "a.exr");
  // box2i of both windows: 65536 x 8191 RGBA, 8 GiB of floats in a file of some kB.
  for (const char* window : {"dataWindow", "displayWindow"}) {
    const std::size_t box = bytes.find(window) + std::string(window).size() + 1 + 6 + 4;
    const std::array<std::int32_t, 4> corners{0, 0, 65535, 8190};
    bytes.replace(box, sizeof(corners), reinterpret_cast<const char*>(corners.data()), sizeof(corners));
  }
  write_bytes(folder / "lie.exr", bytes);
  // Linux: "5" starts the peak of resident memory anew.
  std::ofstream("/proc/self/clear_refs") << "5";
  const long before = peak_resident_mib();
  refusal(ExitCode::Input, [&] { read_image(folder / "lie.exr"); });
  const long grown = peak_resident_mib() - before;
  // The reader holds one block of 2^22 floats (16 MiB). The decoder holds blocks of 16 rows (16 MiB), packed and
  // unpacked, two for each of several threads: 64 MiB a thread for up to 4 threads.
  std::printf("[figure] memory for a header that promises 8 GiB = %ld MiB (limit 272)\n", grown);
  RecordProperty("grown_mib", static_cast<int>(grown));
  EXPECT_GT(before, 0);
  EXPECT_LT(grown, 272);
}

TEST(DamagedImage, LengthOfAnAttributeThatLiesCostsNoMemory) {
  const TempFolder folder;
  write(folder / "a.exr", PixelKind::Float);
  std::string bytes = file_text(folder / "a.exr");
  const std::string name = std::string("fastsplat:engine") + '\0' + "string" + '\0';
  const std::size_t at = bytes.find(name);
  ASSERT_NE(at, std::string::npos);
  const std::int32_t length = 0x7fffffff;
  bytes.replace(at + name.size(), sizeof(length), reinterpret_cast<const char*>(&length), sizeof(length));
  write_bytes(folder / "lie.exr", bytes);
  std::ofstream("/proc/self/clear_refs") << "5";
  const long before = peak_resident_mib();
  const std::string message = refusal(ExitCode::Input, [&] { read_image(folder / "lie.exr"); });
  const long grown = peak_resident_mib() - before;
  EXPECT_THAT(message, HasSubstr("corrupt or truncated EXR: an attribute of 2147483647 bytes"));
  std::printf("[figure] memory for an attribute that promises 2 GiB = %ld MiB (limit 1)\n", grown);
  EXPECT_GT(before, 0);
  EXPECT_LE(grown, 1);
}

/// Soft limit on file sizes; with the signal ignored, writing beyond it fails as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit small{bytes, limit_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  void (*handler_)(int);
  rlimit limit_{};
};

TEST(FullDisk, LeavesNothing) {
  for (const Corrupt& format : kCases) {
    const std::string whole = Specimen(format).whole();
    const TempFolder folder;
    std::fflush(stdout);
    int refused = 0;
    for (std::size_t room = 0; room < whole.size(); room += 1 + whole.size() / 23) {
      std::string message;
      {
        const SmallDisk disk(room);
        message = refusal(ExitCode::Input, [&] { write(folder / format.name, format.kind); });
      }
      EXPECT_THAT(message, HasSubstr(format.name));
      EXPECT_EQ(folder.file_count(), 0u) << "room for " << room << " of " << whole.size() << " bytes";
      ++refused;
    }
    EXPECT_GE(refused, 20);
    {
      const SmallDisk disk(whole.size());
      write(folder / format.name, format.kind);
    }
    EXPECT_EQ(file_text(folder / format.name), whole);
  }
}

TEST(FullDisk, KeepsTheOldFile) {
  for (const Corrupt& format : kCases) {
    const std::string whole = Specimen(format).whole();
    const TempFolder folder;
    write_bytes(folder / format.name, "old");
    std::fflush(stdout);
    {
      const SmallDisk disk(whole.size() / 2);
      refusal(ExitCode::Input, [&] { write(folder / format.name, format.kind); });
    }
    EXPECT_EQ(file_text(folder / format.name), "old");
    EXPECT_EQ(folder.file_count(), 1u);
  }
}

}  // namespace
}  // namespace fastsplat::images

// SPDX-License-Identifier: Apache-2.0
#include "base/images/codec.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdarg>
#include <cstring>

#include "base/lower_case.hpp"
#include "base/machine_error.hpp"

namespace fastsplat::images {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWhat = "cannot read or write TIFF and JPEG: the image library's module ";

[[noreturn]] void refuse(const fs::path& where, const std::string& what, std::string expected, std::string got,
                         std::string fix) {
  throw_machine({where.string(), kWhat + what, std::move(expected), std::move(got), std::move(fix)});
}

/// Relative to the program: copied or installed, it uses only the module that came with it.
fs::path find_module() {
  std::error_code unreadable;
  const fs::path folder = fs::read_symlink("/proc/self/exe", unreadable).parent_path();
  const std::array places{folder / FASTSPLAT_CODEC_FILE,
                          (folder / "../lib/fastsplat" / FASTSPLAT_CODEC_FILE).lexically_normal()};
  for (const auto& place : places) {
    std::error_code ignored;
    if (!unreadable && fs::exists(place, ignored)) return place;
  }
  refuse(places[0], "is missing", "this file or " + places[1].string(), unreadable ? unreadable.message() : "",
         "run `./run build`, copy the module together with the program, or choose .png or .exr");
}

/// libtiff prints its errors to stderr; our message reports them already. OpenImageIO 2.4 replaces the printing
/// functions, 2.5 does not for files in memory.
void silence_libtiff(void* module) {
  using Handler = void (*)(const char* place, const char* format, std::va_list);
  for (const char* setter : {"TIFFSetErrorHandler", "TIFFSetWarningHandler"}) {
    if (auto* set = reinterpret_cast<Handler (*)(Handler)>(::dlsym(module, setter))) set(nullptr);
  }
}

const Codec& open_module() {
  const fs::path path = find_module();
  // Bind lazily, like the program itself: hundreds of libraries have far more functions than a picture calls.
  void* module = ::dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr) {
    const char* reason = ::dlerror();
    refuse(path, "cannot be loaded", {}, reason == nullptr ? "no reason" : reason,
           "install the packages of tools/debian.txt, then run `./run build`");
  }
  const auto* tag = static_cast<const char*>(::dlsym(module, kTagSymbol));
  const auto* table = static_cast<const Codec*>(::dlsym(module, kTableSymbol));
  if (tag == nullptr || table == nullptr || std::strcmp(tag, FASTSPLAT_CODEC_TAG) != 0) {
    refuse(path, "belongs to another build of this program", FASTSPLAT_CODEC_TAG, tag == nullptr ? "no tag" : tag,
           "run `./run build`, or copy the module together with the program");
  }
  silence_libtiff(module);
  return *table;  // never closed: the library's own threads outlive any picture
}

}  // namespace

const Codec& codec() {
  static const Codec& table = open_module();
  return table;
}

void require_library(const fs::path& path) {
  const std::string ending = ending_of(path);
  if (ending != ".png" && ending != ".exr") codec();
}

std::string library_version() { return codec().version(); }

}  // namespace fastsplat::images

#include "volume/byte_reader.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <new>
#include <ostream>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace fastsplat::volume {
namespace {

constexpr int kGzipWindow = 16 + MAX_WBITS;  // zlib's way to say: gzip header and checksum
constexpr std::size_t kChunk = std::size_t{1} << 17;

}  // namespace

struct ByteReader::State {
  std::filesystem::path path;
  std::ifstream file;
  Packing packing = Packing::Plain;
  z_stream stream{};
  std::vector<unsigned char> packed;
  bool ended = false;  // past the last gzip member

  [[noreturn]] void refuse(const std::string& what) const {
    throw_input(
        {.where = path.string(), .what = what, .expected = {}, .got = {}, .fix = "download or copy the file again"});
  }

  std::size_t read_plain(void* out, std::size_t size) {
    file.read(static_cast<char*>(out), static_cast<std::streamsize>(size));
    if (file.bad()) refuse("cannot read the file");
    return static_cast<std::size_t>(file.gcount());
  }

  void refill() {
    if (stream.avail_in != 0) return;
    stream.next_in = packed.data();
    stream.avail_in = static_cast<uInt>(read_plain(packed.data(), packed.size()));
  }

  /// Another gzip member may follow; anything else after the end is ignored, as gzip itself does.
  void next_member() {
    refill();
    ended = stream.avail_in == 0 || *stream.next_in != 0x1f || inflateReset(&stream) != Z_OK;
  }

  std::size_t read_packed(void* out, std::size_t size) {
    stream.next_out = static_cast<unsigned char*>(out);
    std::size_t left = size;
    while (left > 0 && !ended) {
      const auto piece = static_cast<uInt>(std::min(left, kChunk));
      stream.avail_out = piece;
      while (stream.avail_out > 0 && !ended) {
        refill();
        if (stream.avail_in == 0) refuse("the compressed data ends early: the file is truncated");
        const int status = inflate(&stream, Z_NO_FLUSH);
        if (status == Z_MEM_ERROR) throw std::bad_alloc();
        if (status == Z_STREAM_END) {
          next_member();
        } else if (status != Z_OK) {
          refuse(std::string("the compressed data is corrupt: ") +
                 (stream.msg != nullptr ? stream.msg : "not gzip data"));
        }
      }
      left -= piece - stream.avail_out;
    }
    return size - left;
  }
};

Packing packing_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return file.get() == 0x1f && file.get() == 0x8b ? Packing::Gzip : Packing::Plain;
}

ByteReader::ByteReader(const std::filesystem::path& path, std::uint64_t offset, Packing packing)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->packing = packing;
  state_->file.open(path, std::ios::binary);
  state_->file.seekg(static_cast<std::streamoff>(offset));
  if (!state_->file) state_->refuse("cannot open the file");
  if (packing == Packing::Gzip) {
    state_->packed.resize(kChunk);
    if (inflateInit2(&state_->stream, kGzipWindow) != Z_OK) throw std::bad_alloc();
  }
}

ByteReader::~ByteReader() {
  if (state_->packing == Packing::Gzip) inflateEnd(&state_->stream);
}

std::size_t ByteReader::read(void* out, std::size_t size) {
  return state_->packing == Packing::Gzip ? state_->read_packed(out, size) : state_->read_plain(out, size);
}

void ByteReader::verify_rest() {
  if (state_->packing == Packing::Plain) return;
  constexpr int kSurplusChunks = 64;
  std::vector<unsigned char> surplus(kChunk);
  for (int i = 0; i < kSurplusChunks && read(surplus.data(), surplus.size()) > 0; ++i) {
  }
}

void write_gzip(std::ostream& out, const void* data, std::size_t size) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzipWindow, 8, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  std::vector<unsigned char> packed(kChunk);
  const auto* next = static_cast<const unsigned char*>(data);
  int status = Z_OK;
  while (status != Z_STREAM_END) {
    const std::size_t piece = std::min(size, kChunk);
    stream.next_in = const_cast<unsigned char*>(next);  // zlib's C interface; it does not write there
    stream.avail_in = static_cast<uInt>(piece);
    next += piece;
    size -= piece;
    do {
      stream.next_out = packed.data();
      stream.avail_out = static_cast<uInt>(packed.size());
      status = deflate(&stream, size == 0 ? Z_FINISH : Z_NO_FLUSH);
      assert(status != Z_STREAM_ERROR);
      out.write(reinterpret_cast<const char*>(packed.data()),
                static_cast<std::streamsize>(packed.size() - stream.avail_out));
    } while (stream.avail_out == 0);
  }
  deflateEnd(&stream);
}

}  // namespace fastsplat::volume

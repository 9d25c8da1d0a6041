// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/byte_reader.hpp"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <new>
#include <ostream>
#include <string>
#include <vector>

#include "base/machine_error.hpp"

namespace fastsplat::volume {
namespace {

constexpr int kGzipWindow = 16 + MAX_WBITS;    // zlib's code for gzip header and checksum
constexpr int kEitherWindow = 32 + MAX_WBITS;  // gzip or zlib, whichever the data begins with
constexpr std::size_t kChunk = std::size_t{1} << 17;

class PlainFile {
 public:
  PlainFile(const std::filesystem::path& path, std::uint64_t offset) : path_(path), file_(path, std::ios::binary) {
    file_.seekg(static_cast<std::streamoff>(offset));
    if (!file_) throw_machine(failure("cannot open the file"));
  }
  [[noreturn]] void refuse(const std::string& what) const { throw_input(failure(what)); }
  std::size_t read(void* out, std::size_t size) {
    file_.read(static_cast<char*>(out), static_cast<std::streamsize>(size));
    if (file_.bad()) throw_machine(failure("cannot read the file"));
    return static_cast<std::size_t>(file_.gcount());
  }

 private:
  ErrorParts failure(const std::string& what) const {
    return {.where = path_.string(), .what = what, .expected = {}, .got = {}, .fix = "download or copy the file again"};
  }

  std::filesystem::path path_;
  std::ifstream file_;
};

}  // namespace

class ByteReader::Unpacker {
 public:
  explicit Unpacker(PlainFile file) : file_(std::move(file)) {}
  virtual ~Unpacker() = default;
  virtual std::size_t read(void* out, std::size_t size) { return file_.read(out, size); }

 protected:
  PlainFile file_;
};

namespace {

using Unpacker = ByteReader::Unpacker;

/// Common part of zlib and bzip2, whose C interfaces differ only in names. `Codec` holds the stream and advances it.
template <class Codec>
class Unpacked : public Unpacker {
 public:
  template <class... Options>
  explicit Unpacked(PlainFile file, Options... options)
      : Unpacker(std::move(file)), codec_(options...), packed_(kChunk) {}

  std::size_t read(void* out, std::size_t size) override {
    codec_.stream.next_out = static_cast<decltype(codec_.stream.next_out)>(out);
    std::size_t left = size;
    while (left > 0 && !ended_) {
      const auto piece = static_cast<unsigned>(std::min(left, kChunk));
      codec_.stream.avail_out = piece;
      while (codec_.stream.avail_out > 0 && !ended_) {
        refill();
        if (codec_.stream.avail_in == 0) file_.refuse("the compressed data ends early: the file is truncated");
        switch (codec_.step()) {
          case Codec::Step::Further:
            break;
          case Codec::Step::End:
            // Another member may follow; anything else after the end is ignored, as gzip itself does.
            refill();
            ended_ = codec_.stream.avail_in == 0 || !codec_.begins_again();
            break;
          case Codec::Step::Corrupt:
            file_.refuse("the compressed data is corrupt: " + codec_.complaint());
        }
      }
      left -= piece - codec_.stream.avail_out;
    }
    return size - left;
  }

 private:
  void refill() {
    if (codec_.stream.avail_in != 0) return;
    codec_.stream.next_in = reinterpret_cast<decltype(codec_.stream.next_in)>(packed_.data());
    codec_.stream.avail_in = static_cast<unsigned>(file_.read(packed_.data(), packed_.size()));
  }

  Codec codec_;
  std::vector<char> packed_;
  bool ended_ = false;  // past the last member
};

struct Inflate {
  enum class Step { Further, End, Corrupt };
  z_stream stream{};

  explicit Inflate(int window) {
    if (inflateInit2(&stream, window) != Z_OK) throw std::bad_alloc();
  }
  Inflate(const Inflate&) = delete;
  ~Inflate() { inflateEnd(&stream); }
  Step step() {
    const int status = inflate(&stream, Z_NO_FLUSH);
    if (status == Z_MEM_ERROR) throw std::bad_alloc();
    if (status == Z_STREAM_END) return Step::End;
    return status == Z_OK ? Step::Further : Step::Corrupt;
  }
  bool begins_again() { return *stream.next_in == 0x1f && inflateReset(&stream) == Z_OK; }
  std::string complaint() const { return stream.msg != nullptr ? stream.msg : "not gzip data"; }
};

struct Bunzip2 {
  enum class Step { Further, End, Corrupt };
  bz_stream stream{};

  Bunzip2() { start(); }
  Bunzip2(const Bunzip2&) = delete;
  ~Bunzip2() { BZ2_bzDecompressEnd(&stream); }
  Step step() {
    const int status = BZ2_bzDecompress(&stream);
    if (status == BZ_MEM_ERROR) throw std::bad_alloc();
    if (status == BZ_STREAM_END) return Step::End;
    magic_missing_ = status == BZ_DATA_ERROR_MAGIC;
    return status == BZ_OK ? Step::Further : Step::Corrupt;
  }
  bool begins_again() {
    if (*stream.next_in != 'B') return false;
    const bz_stream at = stream;
    BZ2_bzDecompressEnd(&stream);
    start();
    stream.next_in = at.next_in, stream.avail_in = at.avail_in;
    stream.next_out = at.next_out, stream.avail_out = at.avail_out;
    return true;
  }
  std::string complaint() const { return magic_missing_ ? "not bzip2 data" : "incorrect data check"; }

 private:
  void start() {
    stream = {};
    if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  }
  bool magic_missing_ = false;
};

/// Two digits per byte, with blanks and line ends anywhere between.
class HexDigits : public Unpacker {
 public:
  explicit HexDigits(PlainFile file) : Unpacker(std::move(file)), text_(kChunk) {}

  std::size_t read(void* out, std::size_t size) override {
    auto* bytes = static_cast<unsigned char*>(out);
    for (std::size_t i = 0; i < size; ++i) {
      const int high = digit();
      if (high < 0) return i;
      const int low = digit();
      if (low < 0) file_.refuse("the hexadecimal data ends within a byte: the file is truncated");
      bytes[i] = static_cast<unsigned char>(16 * high + low);
    }
    return size;
  }

 private:
  /// Returns -1 at the end.
  int digit() {
    for (;; ++at_) {
      if (at_ == end_) {
        end_ = file_.read(text_.data(), text_.size());
        at_ = 0;
        if (end_ == 0) return -1;
      }
      const char c = text_[at_];
      if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
      ++at_;
      if (c >= '0' && c <= '9') return c - '0';
      if (c >= 'a' && c <= 'f') return c - 'a' + 10;
      if (c >= 'A' && c <= 'F') return c - 'A' + 10;
      file_.refuse(std::string("the hexadecimal data is corrupt: '") + c + "' is not a hexadecimal digit");
    }
  }

  std::vector<char> text_;
  std::size_t at_ = 0, end_ = 0;
};

std::unique_ptr<Unpacker> unpacker_for(PlainFile file, Packing packing) {
  switch (packing) {
    case Packing::Gzip:
    case Packing::Zlib:
      return std::make_unique<Unpacked<Inflate>>(std::move(file), kEitherWindow);
    case Packing::Bzip2:
      return std::make_unique<Unpacked<Bunzip2>>(std::move(file));
    case Packing::Hex:
      return std::make_unique<HexDigits>(std::move(file));
    case Packing::Plain:
    case Packing::Text:
      break;
  }
  return std::make_unique<Unpacker>(std::move(file));
}

void write_deflated(std::ostream& out, const void* data, std::size_t size, int window) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK)
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

}  // namespace

Packing packing_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return file.get() == 0x1f && file.get() == 0x8b ? Packing::Gzip : Packing::Plain;
}

std::uint64_t offset_after_lines(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t lines) {
  PlainFile file(path, offset);
  std::vector<char> chunk(kChunk);
  for (std::size_t left = 0, at = 0; lines > 0; ++offset) {
    if (left == 0) at = 0, left = file.read(chunk.data(), chunk.size());
    if (left-- == 0) file.refuse("the file has fewer lines than its header's line skip");
    lines -= chunk[at++] == '\n' ? 1 : 0;
  }
  return offset;
}

std::uint64_t unpacked_size(const std::filesystem::path& path, std::uint64_t offset, Packing packing) {
  if (packing == Packing::Plain) {
    const std::uint64_t size = std::filesystem::file_size(path);
    return size - std::min(size, offset);
  }
  ByteReader reader(path, offset, packing);
  std::vector<char> chunk(kChunk);
  std::uint64_t size = 0;
  for (std::size_t got = 1; got > 0; size += got) got = reader.read(chunk.data(), chunk.size());
  return size;
}

ByteReader::ByteReader(const std::filesystem::path& path, std::uint64_t offset, Packing packing)
    : unpacker_(unpacker_for(PlainFile(path, offset), packing)), packing_(packing) {}

ByteReader::~ByteReader() = default;

std::size_t ByteReader::read(void* out, std::size_t size) { return unpacker_->read(out, size); }

void ByteReader::verify_rest() {
  if (packing_ == Packing::Plain || packing_ == Packing::Text) return;
  constexpr int kSurplusChunks = 64;
  std::vector<unsigned char> surplus(kChunk);
  for (int i = 0; i < kSurplusChunks && read(surplus.data(), surplus.size()) > 0; ++i) {
  }
}

void write_gzip(std::ostream& out, const void* data, std::size_t size) { write_deflated(out, data, size, kGzipWindow); }
void write_zlib(std::ostream& out, const void* data, std::size_t size) { write_deflated(out, data, size, MAX_WBITS); }

}  // namespace fastsplat::volume

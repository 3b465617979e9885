#include "sources/decompress.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

namespace saccade {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint64_t kLargestChunk = 512u << 20;
constexpr std::size_t kStep = 1u << 20;

std::runtime_error damaged() { return std::runtime_error("its compressed data are damaged"); }

// Grows step by step, to one byte more than the size at most, by which it is seen to be too small. step(in,
// out) consumes from the front of `in`, gives the number of bytes that it wrote to `out`, and sets `done` at
// the end of the data.
template <typename Step>
void decompress_stream(Bytes data, std::uint64_t size, std::vector<std::uint8_t>& out, Step step) {
  out.clear();
  for (bool done = false; !done;) {
    const std::size_t before = out.size(), left = data.size();
    out.resize(before + std::min<std::uint64_t>(kStep, size - before + 1));
    const std::size_t written = step(data, std::span(out).subspan(before), done);
    out.resize(before + written);
    if (out.size() > size) throw std::runtime_error("its compressed data are longer than they claim");
    if (!done && written == 0 && data.size() == left) throw damaged();  // truncated: nothing goes on
  }
  if (out.size() != size) throw std::runtime_error("its compressed data are shorter than they claim");
}

void decompress_lz4(Bytes data, std::uint64_t size, std::vector<std::uint8_t>& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(made,
                                                                             LZ4F_freeDecompressionContext);
  decompress_stream(data, size, out, [&](Bytes& in, std::span<std::uint8_t> to, bool& done) {
    std::size_t written = to.size(), read = in.size();
    const std::size_t next = LZ4F_decompress(context.get(), to.data(), &written, in.data(), &read, nullptr);
    if (LZ4F_isError(next) != 0) throw damaged();
    in = in.subspan(read);
    done = next == 0;
    return written;
  });
}

void decompress_zstd(Bytes data, std::uint64_t size, std::vector<std::uint8_t>& out) {
  constexpr int kLargestWindowLog = 27;  // 128 MB
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, kLargestWindowLog);
  decompress_stream(data, size, out, [&](Bytes& in, std::span<std::uint8_t> to, bool& done) {
    ZSTD_inBuffer from{in.data(), in.size(), 0};
    ZSTD_outBuffer into{to.data(), to.size(), 0};
    const std::size_t next = ZSTD_decompressStream(context.get(), &into, &from);
    if (ZSTD_isError(next) != 0) throw damaged();
    in = in.subspan(from.pos);
    done = next == 0;
    return into.pos;
  });
}

void decompress_bz2(Bytes data, std::uint64_t size, std::vector<std::uint8_t>& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> end(&stream, BZ2_bzDecompressEnd);
  decompress_stream(data, size, out, [&](Bytes& in, std::span<std::uint8_t> to, bool& done) {
    // The library does not write to its input.
    stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(in.data()));
    stream.avail_in = static_cast<unsigned>(std::min<std::size_t>(in.size(), kLargestChunk));
    stream.next_out = reinterpret_cast<char*>(to.data());
    stream.avail_out = static_cast<unsigned>(to.size());
    const unsigned offered = stream.avail_in;
    const int code = BZ2_bzDecompress(&stream);
    if (code != BZ_OK && code != BZ_STREAM_END) throw damaged();
    in = in.subspan(offered - stream.avail_in);
    done = code == BZ_STREAM_END;
    return to.size() - stream.avail_out;
  });
}

}  // namespace

void decompress(std::string_view method, Bytes data, std::uint64_t size, std::vector<std::uint8_t>& out) {
  if (size > kLargestChunk) throw std::runtime_error("it claims more than 512 MB in one chunk");
  if (method.empty() || method == "none") {
    if (data.size() != size) throw std::runtime_error("its size is not that of its data");
    out.assign(data.begin(), data.end());
  } else if (method == "lz4") {
    decompress_lz4(data, size, out);
  } else if (method == "zstd") {
    decompress_zstd(data, size, out);
  } else if (method == "bz2") {
    decompress_bz2(data, size, out);
  } else {
    throw std::runtime_error("its compression is not known: " + std::string(method.substr(0, 20)));
  }
}

}  // namespace saccade

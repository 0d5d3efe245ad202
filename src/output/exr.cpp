#include "output/exr.hpp"

#include <algorithm>
#include <cstdint>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include "lichtmc/error.hpp"

namespace lichtmc {

namespace {

// An output stream of OpenEXR in memory. OpenEXR seeks backwards to write its table of offsets.
class ByteStream final : public Imf::OStream {
 public:
  ByteStream() : Imf::OStream("picture") {}

  void write(const char c[], int n) override {
    const std::size_t end = position_ + static_cast<std::size_t>(n);
    if (bytes_.size() < end) bytes_.resize(end);
    std::copy(c, c + n, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ = end;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

}  // namespace

std::string exr_file(Imf::Header header, std::vector<ExrChannel> channels, const std::string& what) {
  const auto columns = static_cast<std::size_t>(header.dataWindow().max.x) + 1;
  const int rows = header.dataWindow().max.y + 1;
  header.compression() = Imf::ZIP_COMPRESSION;
  try {
    ByteStream stream;
    {
      Imf::FrameBuffer frame;
      for (ExrChannel& channel : channels) {
        header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
        frame.insert(channel.name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(channel.values.data()), sizeof(float),
                                              sizeof(float) * columns));
      }
      Imf::OutputFile file(stream, header);
      file.setFrameBuffer(frame);
      file.writePixels(rows);
    }
    return stream.take();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw RuntimeError("Cannot create " + what + " (" + error.what() + "). Use larger tiles, or free some memory.");
  }
}

}  // namespace lichtmc

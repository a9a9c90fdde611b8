#include "reports/files/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "core/input_file.h"
#include "reports/files/output.h"

namespace umbrameter {
namespace {

constexpr std::string_view own_prefix = "umbrameter.";
constexpr int no_threads = 0;  // compressed in the calling thread

// GLM multiplies columns (M·v) and stores column by column; Imath multiplies rows (v·M) and stores row by row.
// The row-vector form of M is its transpose, so the sixteen numbers stand in memory in the same order:
// Imath's m[i][j] is GLM's column i, row j.
Imath::M44f to_imath(const mat4& matrix) {
  Imath::M44f result;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) result[i][j] = matrix[i][j];
  }
  return result;
}

mat4 from_imath(const Imath::M44f& matrix) {
  mat4 result;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) result[i][j] = matrix[i][j];
  }
  return result;
}

// Strides are in bytes; OpenEXR takes a base pointer to non-const memory even where it only reads.
Imf::Slice slice_of(const Image<float>& image, const Imath::V2i& origin) {
  const std::size_t row = sizeof(float) * static_cast<std::size_t>(image.width);
  return Imf::Slice::Make(Imf::FLOAT, image.pixels.data(), origin, image.width, image.height, sizeof(float), row);
}

Imf::Header header_of(const LayeredImage& image, int width, int height) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const Channel& channel : image.channels) header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
  Imf::addWorldToCamera(header, to_imath(image.world_to_camera));
  Imf::addWorldToNDC(header, to_imath(image.world_to_ndc));
  for (const auto& [key, value] : image.attributes) {
    header.insert(std::string(own_prefix) + key, Imf::StringAttribute(value));
  }
  return header;
}

void check(const std::filesystem::path& path, const LayeredImage& image) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::partial, "cannot write " + path.string(), why);
  };
  if (image.channels.empty()) refuse("the image has no channels");
  const Image<float>& first = image.channels.front().values;
  if (first.empty()) refuse("the image has no pixels");
  std::set<std::string> names;
  for (const Channel& channel : image.channels) {
    // Viewers take what stands before the last dot as the layer, some split at every dot.
    if (channel.name.empty() || std::ranges::count(channel.name, '.') > 1) {
      refuse("'" + channel.name + "' is not a valid channel name: it may have at most one dot");
    }
    if (!names.insert(channel.name).second) refuse("two channels have the name '" + channel.name + "'");
    if (channel.values.width != first.width || channel.values.height != first.height) {
      refuse("channel '" + channel.name + "' differs in size from '" + image.channels.front().name + "'");
    }
  }
}

}  // namespace

void add_layer(LayeredImage& image, const std::string& layer, const Image<float>& values) {
  image.channels.push_back({layer + ".Y", values});
}

namespace {

void add_channels(LayeredImage& image, const std::string& layer, const std::array<const char*, 3>& names,
                  const Image<vec3>& values) {
  for (int c = 0; c < 3; ++c) {
    Channel channel{layer + names[static_cast<std::size_t>(c)], Image<float>(values.width, values.height)};
    for (std::size_t i = 0; i < values.size(); ++i) channel.values[i] = values[i][c];
    image.channels.push_back(std::move(channel));
  }
}

}  // namespace

void add_layer(LayeredImage& image, const std::string& layer, const Image<vec3>& values) {
  add_channels(image, layer, {".X", ".Y", ".Z"}, values);
}

void add_color_layer(LayeredImage& image, const std::string& layer, const Image<vec3>& colors) {
  add_channels(image, layer, {".R", ".G", ".B"}, colors);
}

void write_exr(const std::filesystem::path& path, const LayeredImage& image) {
  check(path, image);
  const Image<float>& first = image.channels.front().values;
  std::string bytes;
  try {
    Imf::StdOSStream stream;
    {
      Imf::OutputFile file(stream, header_of(image, first.width, first.height), no_threads);
      Imf::FrameBuffer buffer;
      for (const Channel& channel : image.channels) buffer.insert(channel.name, slice_of(channel.values, {0, 0}));
      file.setFrameBuffer(buffer);
      file.writePixels(first.height);
    }
    bytes = stream.str();
  } catch (const std::exception& exception) {
    throw Error(ExitCode::partial, "cannot write " + path.string(), exception.what());
  }
  write_text(path, bytes);
}

namespace {

// The most pixels of a side: far beyond any image, and within what OpenEXR can count.
constexpr int longest_side = 1 << 20;

// Width and height of the data window. Throws what OpenEXR throws.
Imath::V2i size_of(const Imf::Header& header) {
  const Imath::Box2i window = header.dataWindow();
  return window.size() + Imath::V2i(1);
}

// Of the file's bytes, which are few if the header is damaged.
LayeredImage decode(Imf::IStream& input, std::uintmax_t bytes) {
  Imf::Header::setMaxImageSize(longest_side, longest_side);
  LayeredImage image;
  Imf::InputFile file(input, no_threads);
  const Imf::Header& header = file.header();
  const Imath::Box2i window = header.dataWindow();
  const Imath::V2i size = size_of(header);
  Imf::FrameBuffer buffer;
  std::size_t channels = 0;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
  // No method stores more than a block of 8 x 8 pixels as one number (DWA), and deflates these 1032 times (RFC 1951).
  constexpr double most_inflated = 64.0 * 1032.0;
  if (2.0 * static_cast<double>(channels) * size.x * size.y > most_inflated * static_cast<double>(bytes)) {
    throw std::runtime_error(
        fmt::format("its {} bytes are too few for its size of {}x{} pixels", bytes, size.x, size.y));
  }
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1) {
      throw std::runtime_error(std::string("channel '") + c.name() + "' is subsampled");
    }
    image.channels.push_back({c.name(), Image<float>(size.x, size.y)});
  }
  for (const Channel& channel : image.channels) buffer.insert(channel.name, slice_of(channel.values, window.min));
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  for (auto a = header.begin(); a != header.end(); ++a) {
    const std::string_view name = a.name();
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    if (text != nullptr && name.substr(0, own_prefix.size()) == own_prefix) {
      image.attributes[std::string(name.substr(own_prefix.size()))] = text->value();
    }
  }
  if (Imf::hasWorldToCamera(header)) image.world_to_camera = from_imath(Imf::worldToCamera(header));
  if (Imf::hasWorldToNDC(header)) image.world_to_ndc = from_imath(Imf::worldToNDC(header));
  return image;
}

}  // namespace

ivec2 size_of_exr(std::string_view bytes) {
  Imf::Header::setMaxImageSize(longest_side, longest_side);
  Imf::StdISStream input;
  input.str(std::string(bytes));
  const Imath::V2i size = size_of(Imf::InputFile(input, no_threads).header());
  return {size.x, size.y};
}

LayeredImage from_exr(std::string_view bytes) {
  Imf::StdISStream input;
  input.str(std::string(bytes));
  return decode(input, bytes.size());
}

LayeredImage read_exr(const std::filesystem::path& path) {
  require_regular_file(path);
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::unreadable_input, "cannot read " + path.string(), why);
  };
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) refuse(std::generic_category().message(errno));
  LayeredImage image;
  try {
    Imf::StdIFStream input(stream, path.c_str());
    image = decode(input, std::filesystem::file_size(path));
  } catch (const std::bad_alloc&) {
    refuse("not enough memory for its size");
  } catch (const std::exception& exception) {
    refuse(exception.what());
  }
  return image;
}

}  // namespace umbrameter

#include "film/output.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "base/error.h"
#include "base/whole_file.h"
#include "film/stamp.h"
#include "film/tonemap.h"

namespace yat {

namespace {

namespace fs = std::filesystem;

enum class Format { kNone, kExr, kPng, kJpeg, kTga };

Format format_of(std::string_view path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (extension == ".exr") return Format::kExr;
  if (extension == ".png") return Format::kPng;
  if (extension == ".tga") return Format::kTga;
  if (extension == ".jpg" || extension == ".jpeg") return Format::kJpeg;
  return Format::kNone;
}

const char* writer_of(Format format) {
  switch (format) {
    case Format::kExr:
      return "openexr";
    case Format::kPng:
      return "png";
    case Format::kTga:
      return "targa";
    default:
      return "jpeg";
  }
}

/// A name for what is written into memory; writers look at its extension.
const char* name_in_memory(Format format) {
  switch (format) {
    case Format::kExr:
      return "picture.exr";
    case Format::kPng:
      return "picture.png";
    case Format::kTga:
      return "picture.tga";
    default:
      return "picture.jpg";
  }
}

void describe(OIIO::ImageSpec& spec, const PictureMetadata& m) {
  spec.attribute("Software", fmt::format("yat {}", m.version));
  spec.attribute("yat:scene", m.scene);
  spec.attribute("yat:scene_hash", fmt::format("{:016x}", m.scene_hash));
  spec.attribute("yat:seed", fmt::format("{}", m.seed));
  spec.attribute("yat:samples_per_pixel", float(m.samples_per_pixel));
  spec.attribute("yat:render_seconds", float(m.render_seconds));
  spec.attribute("yat:isa", m.isa);
  spec.attribute("yat:version", m.version);
  if (m.noise) {
    spec.attribute("yat:relmse", float(m.noise->rel_mse));
    spec.attribute("yat:relmse_low", float(m.noise->low));
    spec.attribute("yat:relmse_high", float(m.noise->high));
    spec.attribute("yat:relmse_epsilon", float(m.noise->epsilon));
    spec.attribute("yat:noise_target", float(m.noise->target));
  }
  // The one text that JPEG keeps.
  spec.attribute(
      "ImageDescription",
      fmt::format("{} (hash {:016x}, seed {}, {} samples per pixel, {:.3f} s, {})", m.scene,
                  m.scene_hash, m.seed, m.samples_per_pixel, m.render_seconds, m.isa));
}

OIIO::ImageSpec exr_spec(uint32_t width, uint32_t height, const FilmSettings& settings,
                         const std::vector<std::string>& channels) {
  OIIO::ImageSpec spec(int(width), int(height), int(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = channels;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  // CIE xy of Rec.709: red, green, blue, white.
  const float chromaticities[8] = {.64f, .33f, .30f, .60f, .15f, .06f, .3127f, .3290f};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
  if (width == settings.crop_width() && height == settings.crop_height()) {
    spec.x = int(settings.crop_x0);
    spec.y = int(settings.crop_y0);
    spec.full_width = int(settings.width);
    spec.full_height = int(settings.height);
  }
  return spec;
}

/// The picture as the bytes of its file. In memory: the writers of PNG and EXR do not notice a full
/// disk, and the one of JPEG ends the program.
std::vector<unsigned char> encode(Format format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                                  const void* pixels) {
  const auto writer = OIIO::ImageOutput::create(writer_of(format));
  if (!writer) throw ResourceError(OIIO::geterror());
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!writer->set_ioproxy(&memory) || !writer->open(name_in_memory(format), spec) ||
      !writer->write_image(type, pixels) || !writer->close())
    throw ResourceError(writer->geterror());
  return bytes;
}

void set_primaries(OIIO::ImageSpec& spec, const FilmSettings& s) {
  const float chromaticities[8] = {s.red[0],  s.red[1],  s.green[0], s.green[1],
                                   s.blue[0], s.blue[1], s.white[0], s.white[1]};
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
}

/// RGB as the channels wanted; sets their number and names. Y is the mean that Rec.709 weighs.
std::vector<float> in_channels(std::span<const float> rgb, PictureFile::Channels channels,
                               OIIO::ImageSpec& spec) {
  using Channels = PictureFile::Channels;
  if (channels == Channels::kRgb) return {rgb.begin(), rgb.end()};
  const bool grey = channels != Channels::kRgba, alpha = channels != Channels::kY;
  spec.nchannels = (grey ? 1 : 3) + alpha;
  spec.channelnames =
      grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  if (alpha) spec.channelnames.push_back("A");
  spec.alpha_channel = alpha ? spec.nchannels - 1 : -1;
  std::vector<float> out;
  out.reserve(rgb.size() / 3 * size_t(spec.nchannels));
  for (size_t i = 0; i + 2 < rgb.size(); i += 3) {
    if (grey)
      out.push_back(.2126f * rgb[i] + .7152f * rgb[i + 1] + .0722f * rgb[i + 2]);
    else
      out.insert(out.end(), {rgb[i], rgb[i + 1], rgb[i + 2]});
    if (alpha) out.push_back(1);
  }
  return out;
}

/// An EXR by the scene's write_exr flags.
std::vector<unsigned char> encode_as_asked(std::span<const float> rgb, uint32_t width,
                                           uint32_t height, const FilmSettings& settings,
                                           const PictureMetadata& metadata,
                                           const PictureFile& how) {
  OIIO::ImageSpec spec = exr_spec(width, height, settings, {"R", "G", "B"});
  if (how.half) spec.set_format(OIIO::TypeDesc::HALF);
  spec.attribute("compression", how.compression);
  std::vector<float> mapped;
  if (how.tone_mapped) {
    mapped = tone_map_linear(rgb, settings);
    set_primaries(spec, settings);
  }
  const std::vector<float> pixels =
      in_channels(how.tone_mapped ? std::span<const float>(mapped) : rgb, how.channels, spec);
  describe(spec, metadata);
  return encode(Format::kExr, spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

std::vector<std::string> split_names(std::string_view names) {
  std::vector<std::string> list;
  for (size_t begin = 0; begin <= names.size();) {
    const size_t end = std::min(names.find(',', begin), names.size());
    list.emplace_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

/// R, G, B and the layers, interleaved, and the names of all channels.
std::vector<float> with_layers(std::span<const float> rgb, std::span<const PictureLayer> layers,
                               std::vector<std::string>& channels) {
  channels = {"R", "G", "B"};
  std::vector<size_t> width;
  for (const PictureLayer& layer : layers) {
    const std::vector<std::string> names = split_names(layer.channels);
    channels.insert(channels.end(), names.begin(), names.end());
    width.push_back(names.size());
  }
  const size_t pixels = rgb.size() / 3;
  std::vector<float> all;
  all.reserve(pixels * channels.size());
  for (size_t i = 0; i < pixels; ++i) {
    all.insert(all.end(), rgb.begin() + std::ptrdiff_t(3 * i),
               rgb.begin() + std::ptrdiff_t(3 * i + 3));
    for (size_t l = 0; l < layers.size(); ++l) {
      const float* const values = &layers[l].values.at(i * width[l]);
      all.insert(all.end(), values, values + width[l]);
    }
  }
  return all;
}

}  // namespace

bool keeps_features(std::string_view path) {
  return format_of(path) == Format::kExr;
}

bool is_picture_name(std::string_view path) {
  return format_of(path) != Format::kNone;
}

bool write_picture(const std::string& path, std::span<const float> rgb, uint32_t width,
                   uint32_t height, const FilmSettings& settings, const PictureMetadata& metadata,
                   std::span<const PictureLayer> layers, const PictureFile* wanted) {
  const Format format = format_of(path);
  if (format == Format::kNone)
    throw UsageError(
        fmt::format("{}: pictures are written as .exr, .png, .jpg, .jpeg or .tga", path));
  if (rgb.size() != size_t(width) * height * 3 || rgb.empty())
    throw ResourceError(fmt::format("error: {}: a picture of {} x {} has {} numbers, not {}", path,
                                    width, height, size_t(width) * height * 3, rgb.size()));

  const PictureFile as_is;
  const PictureFile& how = wanted ? *wanted : as_is;
  std::vector<unsigned char> file;
  bool stamped = metadata.stamp.empty();
  try {
    if (format == Format::kExr && wanted) {
      file = encode_as_asked(rgb, width, height, settings, metadata, how);
    } else if (format == Format::kExr) {
      std::vector<std::string> channels;
      const std::vector<float> all = with_layers(rgb, layers, channels);
      OIIO::ImageSpec spec = exr_spec(width, height, settings, channels);
      describe(spec, metadata);
      file = encode(format, spec, OIIO::TypeDesc::FLOAT, all.data());
    } else {
      std::vector<float> display = tone_map(rgb, settings);
      if (!metadata.stamp.empty()) stamped = stamp_bar(display, width, height, metadata.stamp);
      OIIO::ImageSpec spec(int(width), int(height), 3, OIIO::TypeDesc::UINT8);
      if (format == Format::kJpeg) spec.attribute("Compression", "jpeg:95");
      const std::vector<float> values = in_channels(display, how.channels, spec);
      describe(spec, metadata);
      if (how.deep) {
        spec.set_format(OIIO::TypeDesc::UINT16);
        std::vector<uint16_t> words(values.size());
        std::transform(values.begin(), values.end(), words.begin(),
                       [](float c) { return uint16_t(quantise(c, 65535)); });
        file = encode(format, spec, OIIO::TypeDesc::UINT16, words.data());
      } else {
        // LuxRender's Targa files round differently (lxs 4.2, step 9).
        const bool tga = format == Format::kTga;
        std::vector<uint8_t> bytes(values.size());
        std::transform(values.begin(), values.end(), bytes.begin(), [&](float c) {
          return uint8_t(tga ? std::min(quantise(c, 256), 255u) : quantise(c, 255));
        });
        file = encode(format, spec, OIIO::TypeDesc::UINT8, bytes.data());
      }
    }
  } catch (const ResourceError& e) {
    throw ResourceError(fmt::format("error: {}: cannot make the picture: {}", path, e.what()));
  }
  write_whole_file(path, {reinterpret_cast<const char*>(file.data()), file.size()});
  return stamped;
}

}  // namespace yat

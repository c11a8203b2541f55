#include "scene/image_store.h"

#include <OpenImageIO/imagebuf.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace yat {

namespace {

bool is_bytes(TexelFormat format) {
  return format == TexelFormat::kByte1 || format == TexelFormat::kByte4;
}
uint32_t channels_of(TexelFormat format) {
  return format == TexelFormat::kByte1 || format == TexelFormat::kFloat1 ? 1 : 4;
}
float stored_one(TexelFormat format) {
  return is_bytes(format) ? 255.f : 1.f;
}

/// Texels of whole tiles times channels, in bytes or words.
size_t units(const TexelLevel& level, TexelFormat format) {
  return size_t((level.width + 3) / 4) * ((level.height + 3) / 4) * 16 * channels_of(format);
}

/// Place of channel 0 of a texel, in bytes or words.
size_t unit_of(const TexelLevel& level, TexelFormat format, uint32_t x, uint32_t y) {
  const size_t tile = size_t(y / 4) * ((level.width + 3) / 4) + x / 4;
  return (tile * 16 + y % 4 * 4 + x % 4) * channels_of(format);
}

void allocate(TexelLevel& level, TexelFormat format) {
  level.words.assign(is_bytes(format) ? units(level, format) / 4 : units(level, format), 0);
}

void write_texel(TexelLevel& level, TexelFormat format, uint32_t x, uint32_t y,
                 const float* channels) {
  const size_t at = unit_of(level, format, x, y);
  for (uint32_t k = 0; k < channels_of(format); ++k) {
    if (!is_bytes(format)) {
      level.words[at + k] = std::bit_cast<uint32_t>(channels[k]);
      continue;
    }
    // Bytes from the low end, whatever the machine's order.
    const auto byte = uint32_t(std::lround(std::clamp(channels[k], 0.f, 255.f)));
    uint32_t& word = level.words[(at + k) / 4];
    const uint32_t shift = uint32_t((at + k) % 4 * 8);
    word = (word & ~(255u << shift)) | byte << shift;
  }
}

/// Which texels of a row of `size` a texel of the next level covers, and how much of each.
struct Cover {
  uint32_t first = 0;
  double weight[4] = {};
};
Cover cover(uint32_t i, uint32_t size, uint32_t next) {
  Cover c;
  const double ratio = double(size) / next, begin = i * ratio, end = (i + 1) * ratio;
  c.first = uint32_t(begin);
  for (uint32_t k = 0; k < 4 && c.first + k < size; ++k)
    c.weight[k] =
        std::max(0., std::min(end, c.first + k + 1.) - std::max(begin, c.first + double(k)));
  for (double& w : c.weight) w /= ratio;
  return c;
}

}  // namespace

std::array<float, 4> read_texel(const TexelLevel& level, TexelFormat format, uint32_t x,
                                uint32_t y) {
  const size_t at = unit_of(level, format, x, y);
  std::array<float, 4> texel{};
  for (uint32_t k = 0; k < channels_of(format); ++k)
    texel[k] = is_bytes(format) ? float(level.words[(at + k) / 4] >> ((at + k) % 4 * 8) & 255u)
                                : std::bit_cast<float>(level.words[at + k]);
  if (channels_of(format) == 1) texel = {texel[0], texel[0], texel[0], stored_one(format)};
  return texel;
}

TexelLevel halve(const TexelLevel& level, TexelFormat format, double gamma) {
  TexelLevel out;
  out.width = std::max(1u, level.width / 2);
  out.height = std::max(1u, level.height / 2);
  allocate(out, format);
  const double one = double(stored_one(format));
  std::array<double, 256> table{};
  for (uint32_t i = 0; i < 256; ++i) table[i] = std::pow(i / 255., gamma);
  const auto decode = [&](float texel) {
    if (is_bytes(format)) return table[size_t(texel)];
    return std::copysign(std::pow(std::fabs(double(texel)), gamma), double(texel));
  };
  const auto encode = [&](double light) {
    return float(std::copysign(std::pow(std::fabs(light), 1 / gamma), light) * one);
  };
  for (uint32_t y = 0; y < out.height; ++y) {
    const Cover rows = cover(y, level.height, out.height);
    for (uint32_t x = 0; x < out.width; ++x) {
      const Cover columns = cover(x, level.width, out.width);
      double sum[4] = {};
      for (uint32_t j = 0; j < 4; ++j)
        for (uint32_t i = 0; i < 4 && rows.weight[j] > 0; ++i) {
          if (!(columns.weight[i] > 0)) continue;
          const auto texel = read_texel(level, format, columns.first + i, rows.first + j);
          for (uint32_t k = 0; k < 4; ++k)
            // Alpha is not encoded.
            sum[k] +=
                rows.weight[j] * columns.weight[i] * (k < 3 ? decode(texel[k]) : double(texel[k]));
        }
      const float encoded[4] = {encode(sum[0]), encode(sum[1]), encode(sum[2]), float(sum[3])};
      write_texel(out, format, x, y, encoded);
    }
  }
  return out;
}

uint64_t ImageStore::Image::bytes() const {
  uint64_t sum = 0;
  for (const TexelLevel& level : levels) sum += level.words.size() * 4;
  return sum;
}

uint32_t ImageStore::read(const std::string& path, bool mips, double gamma, std::string& problem) {
  // Gamma matters to what is averaged only.
  const auto key = std::tuple(path, mips, mips ? gamma : 1.);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;

  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // alpha never affects colour
  OIIO::ImageBuf file(path, 0, 0, nullptr, &config);
  if (!file.init_spec(path, 0, 0)) {
    problem = file.geterror();
    return kNone;
  }
  const bool bytes = file.spec().format == OIIO::TypeDesc::UINT8;
  if (!file.read(0, 0, true, bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT) ||
      file.nchannels() < 1 || file.spec().width < 1 || file.spec().height < 1) {
    problem = file.geterror();
    if (problem.empty()) problem = "it has no pixels";
    return kNone;
  }
  const auto channels = uint32_t(file.nchannels());
  Image image;
  image.mips = mips;
  image.gamma = gamma > 0 && std::isfinite(gamma) ? gamma : 1;
  image.format = channels == 1 ? (bytes ? TexelFormat::kByte1 : TexelFormat::kFloat1)
                               : (bytes ? TexelFormat::kByte4 : TexelFormat::kFloat4);
  const float one = stored_one(image.format);
  TexelLevel level;
  level.width = uint32_t(file.spec().width);
  level.height = uint32_t(file.spec().height);
  allocate(level, image.format);
  const auto* as_bytes = static_cast<const uint8_t*>(file.localpixels());
  const auto* as_floats = static_cast<const float*>(file.localpixels());
  // Grey, grey and alpha, or colour and perhaps alpha.
  const uint32_t green = channels >= 3 ? 1 : 0, blue = channels >= 3 ? 2 : 0;
  const uint32_t alpha = channels == 2 ? 1 : channels >= 4 ? 3 : kNone;
  float largest = 0;
  glm::dvec3 sum(0.);
  uint64_t counted = 0;
  const uint64_t every = std::max<uint64_t>(1, uint64_t(level.width) * level.height / 65536);
  for (uint32_t y = 0; y < level.height; ++y)
    for (uint32_t x = 0; x < level.width; ++x) {
      const size_t at = (size_t(y) * level.width + x) * channels;
      const auto channel = [&](uint32_t k) {
        return bytes ? float(as_bytes[at + k]) : as_floats[at + k];
      };
      float texel[4] = {channel(0), channel(green), channel(blue),
                        alpha == kNone ? one : channel(alpha)};
      bool bad = false;
      for (float& value : texel)
        if (!std::isfinite(value)) {
          value = 0;
          bad = true;
        }
      image.bad += bad;
      for (uint32_t k = 0; k < 3; ++k) largest = std::max(largest, texel[k]);
      largest = std::max(largest, texel[3]);
      if ((uint64_t(y) * level.width + x) % every == 0) {
        for (uint32_t k = 0; k < 3; ++k)
          sum[int(k)] += std::pow(std::max(0., double(texel[k]) / double(one)), image.gamma);
        ++counted;
      }
      write_texel(level, image.format, x, y, texel);
    }
  image.largest = double(largest) / double(one);
  image.mean = glm::dvec3(std::pow(sum.x / double(counted), 1 / image.gamma),
                          std::pow(sum.y / double(counted), 1 / image.gamma),
                          std::pow(sum.z / double(counted), 1 / image.gamma));
  image.levels.push_back(std::move(level));
  while (mips && image.levels.size() < kTexelLevels &&
         (image.levels.back().width > 1 || image.levels.back().height > 1))
    image.levels.push_back(halve(image.levels.back(), image.format, image.gamma));

  const auto row = uint32_t(images_.size());
  bytes_ += image.bytes();
  images_.push_back(std::move(image));
  known_.emplace(key, row);
  fit();
  return row;
}

/// Leaves out finest levels, of the largest image each time, until the rest fits.
void ImageStore::fit() {
  while (bytes_ > limit_) {
    const auto largest =
        std::max_element(images_.begin(), images_.end(), [](const Image& a, const Image& b) {
          return a.levels.front().words.size() < b.levels.front().words.size();
        });
    TexelLevel& finest = largest->levels.front();
    if (finest.width == 1 && finest.height == 1) return;  // nothing is left to leave out
    bytes_ -= largest->bytes();
    if (largest->levels.size() > 1)
      largest->levels.erase(largest->levels.begin());
    else
      finest = halve(finest, largest->format, largest->gamma);
    bytes_ += largest->bytes();
    ++left_out_;
  }
}

ImageStore::Place ImageStore::place(uint32_t row) const {
  uint64_t word = 0;
  for (uint32_t i = 0; i < row; ++i) word += images_[i].bytes() / 4;
  const Image& image = images_[row];
  return {uint32_t(word), image.levels.front().width, image.levels.front().height,
          uint32_t(image.levels.size())};
}

Texels ImageStore::take() {
  Texels texels;
  texels.images = uint32_t(images_.size());
  texels.words.resize_unset(bytes_ / 4);
  texels.levels.resize(size_t(texels.images) * kTexelLevels);
  size_t word = 0;
  for (size_t i = 0; i < images_.size(); ++i)
    for (size_t l = 0; l < images_[i].levels.size(); ++l) {
      TexelLevel& level = images_[i].levels[l];
      texels.levels[i * kTexelLevels + l] = uint32_t(word);
      std::memcpy(texels.words.data() + word, level.words.data(), level.words.size() * 4);
      word += level.words.size();
      level.words = {};
    }
  return texels;
}

}  // namespace yat

#include "converge/pixel_moments.h"

#include <cstring>
#include <stdexcept>

namespace yat {

namespace {

constexpr char kMagic[8] = {'y', 'a', 't', 'm', 'o', 'm', '0', '1'};

struct Header {
  char magic[8];
  uint32_t width, height, count, unused;
};

}  // namespace

PixelMoments::PixelMoments(uint32_t width, uint32_t height)
    : width_(width),
      height_(height),
      mean_(size_t(width) * height * 3),
      squares_(size_t(width) * height * 3) {}

void PixelMoments::add(const Image& picture) {
  if (picture.rgb.size() != mean_.size() || picture.width != width_)
    throw std::invalid_argument("PixelMoments::add: another size");
  ++count_;
  for (size_t i = 0; i < mean_.size(); ++i) {
    const double x = double(picture.rgb[i]), before = x - mean_[i];
    mean_[i] += before / count_;
    squares_[i] += before * (x - mean_[i]);
  }
}

std::vector<double> PixelMoments::variance() const {
  std::vector<double> variance(squares_.size());
  if (count_ < 2) return variance;
  for (size_t i = 0; i < variance.size(); ++i) variance[i] = squares_[i] / (count_ - 1);
  return variance;
}

Image PixelMoments::mean_image() const {
  Image image{width_, height_, std::vector<float>(mean_.size()), true};
  for (size_t i = 0; i < mean_.size(); ++i) image.rgb[i] = float(mean_[i]);
  return image;
}

std::string PixelMoments::bytes() const {
  Header header{{}, width_, height_, count_, 0};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof header);
  for (const std::vector<double>* values : {&mean_, &squares_})
    bytes.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(double));
  return bytes;
}

bool PixelMoments::restore(std::string_view bytes) {
  Header header;
  const size_t each = mean_.size() * sizeof(double);
  if (bytes.size() != sizeof header + 2 * each) return false;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0 || header.width != width_ ||
      header.height != height_)
    return false;
  count_ = header.count;
  std::memcpy(mean_.data(), bytes.data() + sizeof header, each);
  std::memcpy(squares_.data(), bytes.data() + sizeof header + each, each);
  return true;
}

}  // namespace yat

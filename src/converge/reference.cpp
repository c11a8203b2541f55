#include "converge/reference.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "base/error.h"
#include "converge/hash.h"

namespace yat {

namespace {

std::optional<uint64_t> number_in(const OIIO::ImageSpec& spec, const char* attribute, int base) {
  const std::string text(spec.get_string_attribute(attribute));
  uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

/// Variance of the mean, if the channels for it are there.
std::vector<double> variance_in(OIIO::ImageInput& file) {
  const OIIO::ImageSpec& spec = file.spec();
  const auto n = size_t(spec.nchannels);
  size_t place[4];
  constexpr const char* kNames[4] = {"variance.R", "variance.G", "variance.B", "sample_count"};
  for (size_t c = 0; c < 4; ++c) {
    const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), kNames[c]);
    if (found == spec.channelnames.end()) return {};
    place[c] = size_t(found - spec.channelnames.begin());
  }
  const size_t pixels = size_t(spec.width) * size_t(spec.height);
  std::vector<float> all(pixels * n);
  if (!file.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, all.data())) return {};
  std::vector<double> variance(pixels * 3);
  for (size_t p = 0; p < pixels; ++p)
    for (size_t c = 0; c < 3; ++c)
      variance[3 * p + c] =
          double(all[p * n + place[c]]) / std::max(1., double(all[p * n + place[3]]));
  return variance;
}

}  // namespace

Reference read_reference(const std::string& path) {
  Reference reference;
  reference.path = path;
  reference.image = read_image(path);
  if (!reference.image.scene_referred)
    throw Error(fmt::format("{}: error: holds display values, not radiance: give an .exr", path));
  if (!std::all_of(reference.image.rgb.begin(), reference.image.rgb.end(),
                   [](float v) { return std::isfinite(v); }))
    throw Error(fmt::format("{}: error: holds values that are not finite: render it anew", path));
  reference.hash = fnv1a_of_file(path);
  if (const auto file = OIIO::ImageInput::open(path)) {
    const OIIO::ImageSpec spec = file->spec();
    reference.samples_per_pixel = double(spec.get_float_attribute("yat:samples_per_pixel"));
    reference.seed = number_in(spec, "yat:seed", 10);
    reference.scene_hash = number_in(spec, "yat:scene_hash", 16);
    reference.variance = variance_in(*file);
  }
  return reference;
}

Reference reference_of(const PixelMoments& parts, uint32_t part_samples) {
  if (parts.count() < 2) throw std::invalid_argument("reference_of: fewer than two parts");
  Reference reference;
  reference.image = parts.mean_image();
  reference.variance = parts.variance();
  for (double& v : reference.variance) v /= parts.count();
  reference.degrees = parts.count() - 1;
  reference.samples_per_pixel = double(part_samples) * parts.count();
  return reference;
}

double mean_variance(const Reference& reference) {
  double sum = 0;
  for (const double v : reference.variance) sum += v;
  return reference.variance.empty() ? 0 : sum / double(reference.variance.size());
}

double mean_relative_variance(const Reference& reference, double epsilon) {
  double sum = 0;
  for (size_t i = 0; i < reference.variance.size(); ++i) {
    const double r = double(reference.image.rgb[i]);
    sum += reference.variance[i] / (r * r + epsilon);
  }
  return reference.variance.empty() ? 0 : sum / double(reference.variance.size());
}

}  // namespace yat

#include "film/features.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "base/error.h"

namespace yat {

namespace {

/// Depth of the background: far, and finite so that compositors can go on calculating.
constexpr float kFarDepth = 1e10f;

constexpr std::array<FeatureInfo, kFeatures> kInfo = {{
    {"albedo", "albedo.R,albedo.G,albedo.B", 3, FeatureMean::kOverSamples, 0},
    {"normal", "normal.X,normal.Y,normal.Z", 3, FeatureMean::kOverSamples, 0},
    {"geometric_normal", "geometric_normal.X,geometric_normal.Y,geometric_normal.Z", 3,
     FeatureMean::kOverSamples, 0},
    {"depth", "Z", 1, FeatureMean::kOverHits, kFarDepth},
    {"position", "position.X,position.Y,position.Z", 3, FeatureMean::kOverHits, 0},
    {"uv", "uv.U,uv.V", 2, FeatureMean::kOverHits, 0},
    {"direct", "direct.R,direct.G,direct.B", 3, FeatureMean::kOverSamples, 0},
    {"indirect", "indirect.R,indirect.G,indirect.B", 3, FeatureMean::kOverSamples, 0},
    {"variance", "variance.R,variance.G,variance.B", 3, FeatureMean::kOverSamples, 0},
    {"sample_count", "sample_count", 1, FeatureMean::kOverSamples, 0},
    {"object_id", "object_id", 1, FeatureMean::kOfFirstHit, 0},
    {"material_id", "material_id", 1, FeatureMean::kOfFirstHit, 0},
}};

/// What the film can hold of a value.
float held(float x) {
  if (std::isnan(x)) return 0;
  return std::clamp(x, -kLargestSample, kLargestSample);
}

/// Unbiased variance of n samples from their sum and their squares' sum.
float variance_of(Fixed sum, Fixed squares, uint64_t n) {
  if (n < 2) return 0;
  const double mean = from_fixed(sum) / double(n), mean_square = from_fixed(squares) / double(n);
  return float(std::max(0., mean_square - mean * mean) * double(n) / double(n - 1));
}

}  // namespace

const FeatureInfo& feature_info(Feature feature) {
  return kInfo.at(uint32_t(feature));
}

FeatureSet parse_features(std::string_view option, std::string_view list) {
  FeatureSet set = 0;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const std::string_view name = list.substr(begin, end - begin);
    begin = end + 1;
    if (name == "all") {
      set = (1u << kFeatures) - 1;
      continue;
    }
    const auto found = std::find_if(kInfo.begin(), kInfo.end(),
                                    [&](const FeatureInfo& i) { return i.name == name; });
    if (found == kInfo.end()) {
      std::vector<std::string_view> names;
      for (const FeatureInfo& i : kInfo) names.push_back(i.name);
      throw UsageError(fmt::format("{} {}: \"{}\" is not known{}; choose from all, {}", option,
                                   list, name, did_you_mean(name, names), fmt::join(names, ", ")));
    }
    set |= 1u << uint32_t(found - kInfo.begin());
  }
  return set;
}

std::string feature_names(FeatureSet set) {
  std::vector<std::string_view> names;
  for (uint32_t f = 0; f < kFeatures; ++f)
    if (set >> f & 1) names.push_back(kInfo[f].name);
  return fmt::format("{}", fmt::join(names, ","));
}

void FeaturePlane::add(size_t pixel, float x, float y, float z) noexcept {
  sums_[pixel].add(held(x), held(y), held(z));
}

void FeaturePlane::merge(const FeaturePlane& other) {
  for (size_t i = 0; i < sums_.size(); ++i) sums_[i].merge(other.sums_[i]);
}

FeatureFilm::FeatureFilm(uint32_t width, uint32_t height, FeatureSet set)
    : width_(width), height_(height), set_(set), ids_(has_ids() ? size_t(width) * height : 0) {
  for (uint32_t f = 0; f < kFeatures; ++f) {
    if (!has(Feature(f)) || Feature(f) == Feature::kSampleCount ||
        feature_info(Feature(f)).mean == FeatureMean::kOfFirstHit)
      continue;
    place_[f] = uint32_t(planes_.size());
    planes_.emplace_back(size_t(width) * height);
  }
}

void FeatureFilm::merge(const FeatureFilm& other) {
  if (other.width_ != width_ || other.height_ != height_ || other.set_ != set_)
    throw std::invalid_argument("FeatureFilm::merge: the films differ");
  for (size_t i = 0; i < planes_.size(); ++i) planes_[i].merge(other.planes_[i]);
  ids_.merge(other.ids_);
}

size_t FeatureFilm::bytes() const {
  size_t sum = ids_.bytes();
  for (const FeaturePlane& plane : planes_) sum += plane.bytes();
  return sum;
}

std::vector<float> FeatureFilm::resolve(Feature feature, const Film& film) const {
  const FeatureInfo& info = feature_info(feature);
  const size_t pixels = size_t(width_) * height_;
  std::vector<float> picture(pixels * info.count, info.background);
  for (size_t i = 0; i < pixels; ++i) {
    float* const to = &picture[i * info.count];
    const FilmPixel& all = film.data()[i];
    if (feature == Feature::kSampleCount) {
      *to = float(all.samples);
      continue;
    }
    if (info.mean == FeatureMean::kOfFirstHit) {
      *to = float(feature == Feature::kObjectId ? ids_.at(i).object : ids_.at(i).material);
      continue;
    }
    const FilmPixel& sums = plane(feature).at(i);
    const Fixed values[3] = {sums.r, sums.g, sums.b};
    const Fixed radiance[3] = {all.r, all.g, all.b};
    const uint64_t n = info.mean == FeatureMean::kOverHits ? sums.samples : all.samples;
    if (!n) continue;
    for (uint32_t c = 0; c < info.count; ++c)
      to[c] = feature == Feature::kVariance ? variance_of(radiance[c], values[c], n)
                                            : float(from_fixed(values[c]) / double(n));
  }
  return picture;
}

}  // namespace yat

#include "film/film_parts.h"

#include <stdexcept>

namespace yat {

namespace {

/// Radiance, or what light is divided by: must have the picture's weights.
bool goes_with_light(Feature feature) {
  return feature == Feature::kAlbedo || feature == Feature::kDirect ||
         feature == Feature::kIndirect;
}

/// The mean of both halves' means; where one half has no sample, the other's.
std::vector<float> mean_of_halves(Feature feature, const FilmParts::Part& a,
                                  const FilmParts::Part& b) {
  std::vector<float> values = a.features->resolve(feature, a.film);
  const std::vector<float> others = b.features->resolve(feature, b.film);
  const size_t channels = feature_info(feature).count;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!b.film.data()[i / channels].samples) continue;
    values[i] = a.film.data()[i / channels].samples ? .5f * values[i] + .5f * others[i] : others[i];
  }
  return values;
}

}  // namespace

FilmParts::FilmParts(uint32_t width, uint32_t height, FeatureSet features, uint32_t count) {
  if (count < 1 || count > 2) throw std::invalid_argument("FilmParts: one part or two halves");
  for (uint32_t i = 0; i < count; ++i) {
    parts_.push_back({Film(width, height), {}});
    if (features) parts_.back().features.emplace(width, height, features);
  }
}

uint64_t FilmParts::total_samples() const {
  uint64_t total = 0;
  for (const Part& part : parts_) total += part.film.total_samples();
  return total;
}

size_t FilmParts::bytes() const {
  size_t total = 0;
  for (const Part& part : parts_)
    total += part.film.bytes() + (part.features ? part.features->bytes() : 0);
  return total;
}

std::vector<float> FilmParts::resolve() const {
  return parts_.size() == 1 ? parts_[0].film.resolve()
                            : resolve_halves(parts_[0].film, parts_[1].film, weigh);
}

std::vector<PictureLayer> FilmParts::resolve_features() const {
  std::vector<PictureLayer> layers;
  if (!parts_[0].features) return layers;
  std::optional<Part> merged;
  if (parts_.size() == 2) {
    merged = parts_[0];
    merged->film.merge(parts_[1].film);
    merged->features->merge(*parts_[1].features);
  }
  const Part& all = merged ? *merged : parts_[0];
  for (uint32_t f = 0; f < kFeatures; ++f) {
    const Feature feature{f};
    if (!all.features->has(feature)) continue;
    const bool halves = parts_.size() == 2 && weigh == Weigh::kEqually && goes_with_light(feature);
    layers.push_back({std::string(feature_info(feature).channels),
                      halves ? mean_of_halves(feature, parts_[0], parts_[1])
                             : all.features->resolve(feature, all.film)});
  }
  return layers;
}

}  // namespace yat

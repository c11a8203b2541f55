// IES photometric files, LM-63, type C (lxs 6.3): candela over a grid of angles, as a picture.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "scene/light_compiler.h"
#include "scene/numbers.h"
#include "scene/read_file.h"

namespace yat {

namespace {

/// The numbers after the keywords, one by one; white space and commas separate them.
class NumberList {
 public:
  explicit NumberList(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}
  /// NaN when there is none.
  double next() {
    while (at_ != end_ && (std::isspace(static_cast<unsigned char>(*at_)) || *at_ == ',')) ++at_;
    const auto read = read_number<double>(at_, end_);
    if (read.status != NumberStatus::kOk) return std::nan("");
    at_ = read.end;
    return read.value;
  }
  /// A count of 1 to 100 000, or 0.
  size_t count() {
    const double n = next();
    return n >= 1 && n <= 1e5 ? size_t(n) : 0;
  }
  /// n numbers; `good` becomes false where one is missing.
  std::vector<double> list(size_t n, bool& good) {
    std::vector<double> numbers;
    while (numbers.size() < n && good) {
      numbers.push_back(next());
      good = std::isfinite(numbers.back());
    }
    return numbers;
  }

 private:
  const char *at_, *end_;
};

/// Intensities by angle [degrees]; both lists of angles ascend.
struct Photometry {
  std::vector<double> vertical, horizontal;
  std::vector<double> candela;  ///< one row of verticals per horizontal

  /// Linear between the angles; 0 beyond the vertical ones.
  double at(double theta, double phi) const {
    const auto [v, fv] = place(vertical, theta);
    if (theta < vertical.front() || theta > vertical.back()) return 0;
    const auto [h, fh] = place(horizontal, folded(phi));
    const auto value = [&](size_t j, size_t i) {
      return candela[std::min(j, horizontal.size() - 1) * vertical.size() +
                     std::min(i, vertical.size() - 1)];
    };
    return (1 - fh) * ((1 - fv) * value(h, v) + fv * value(h, v + 1)) +
           fh * ((1 - fv) * value(h + 1, v) + fv * value(h + 1, v + 1));
  }

 private:
  struct Place {
    size_t row;
    double rest;
  };
  static Place place(const std::vector<double>& angles, double angle) {
    const auto after = std::upper_bound(angles.begin(), angles.end(), angle);
    if (after == angles.begin()) return {0, 0};
    if (after == angles.end()) return {angles.size() - 1, 0};
    return {size_t(after - angles.begin()) - 1, (angle - after[-1]) / (after[0] - after[-1])};
  }
  /// phi brought to where the profile is given: its last angle says how it repeats.
  double folded(double phi) const {
    const double last = horizontal.back();
    if (last == 0) return 0;
    if (last > 180) return phi;
    const double half = phi > 180 ? 360 - phi : phi;
    return last > 90 || half <= 90 ? half : 180 - half;
  }
};

/// Empty, and why, if the text is not what is understood.
std::optional<Photometry> parse(std::string_view text, std::string& why) {
  const size_t tilt = text.find("TILT=");
  if (tilt == std::string_view::npos) {
    why = "it has no TILT line";
    return std::nullopt;
  }
  std::string_view rest = text.substr(tilt + 5);
  const bool included = rest.starts_with("INCLUDE");
  if (!included && !rest.starts_with("NONE")) {
    why = "its TILT is in another file";
    return std::nullopt;
  }
  NumberList numbers(rest.substr(included ? 7 : 4));
  bool good = true;
  if (included) {
    numbers.next();
    const size_t pairs = numbers.count();
    numbers.list(2 * pairs, good);
  }
  why = "its numbers are not those of LM-63";
  numbers.list(2, good);  // lamps and their lumens: the candela hold them
  const double multiplier = numbers.next();
  const size_t verticals = numbers.count(), horizontals = numbers.count();
  const double type = numbers.next();
  numbers.list(6, good);  // units, extents, ballast, for the future
  numbers.next();         // watts
  if (!good || !std::isfinite(multiplier) || verticals == 0 || horizontals == 0 ||
      verticals * horizontals > 1'000'000)
    return std::nullopt;
  if (type != 1) {
    why = "it is not photometry of type C";
    return std::nullopt;
  }
  Photometry photometry;
  photometry.vertical = numbers.list(verticals, good);
  photometry.horizontal = numbers.list(horizontals, good);
  photometry.candela = numbers.list(verticals * horizontals, good);
  const auto ascends = [](const std::vector<double>& v) {
    return std::adjacent_find(v.begin(), v.end(), std::greater_equal<>()) == v.end();
  };
  if (!good || !ascends(photometry.vertical) || !ascends(photometry.horizontal))
    return std::nullopt;
  for (double& c : photometry.candela) c = std::max(0., c * multiplier);
  return photometry;
}

}  // namespace

std::optional<LightPicture> read_ies(Parameters& p, const std::string& name, bool flip_z,
                                     const Description& description) {
  const SourceLoc loc = p.loc("iesname");
  const auto fail = [&](std::string_view why) {
    p.diagnostics().error(
        loc, fmt::format("IES profile \"{}\" {}: {} shines without it", name, why, p.what()));
    return std::nullopt;
  };
  const std::string path = find_data_file(name, loc, description, p.diagnostics());
  if (path.empty()) return fail("not found");
  FileText file;
  if (const std::string error = file.read(path); !error.empty())
    return fail(fmt::format("cannot be read ({})", error));
  std::string why;
  const std::optional<Photometry> photometry = parse(file.view(), why);
  if (!photometry) return fail(fmt::format("cannot be used ({})", why));
  // Half a degree a texel: profiles are given every degree or coarser.
  LightPicture picture{720, 360, {}};
  picture.texels.reserve(size_t(picture.width) * picture.height);
  for (uint32_t y = 0; y < picture.height; ++y)
    for (uint32_t x = 0; x < picture.width; ++x) {
      const double theta = (y + .5) * 180 / picture.height, phi = (x + .5) * 360 / picture.width;
      picture.texels.emplace_back(float(photometry->at(flip_z ? 180 - theta : theta, phi)));
    }
  return picture;
}

}  // namespace yat

// side_by_side OUT.png YAT.png REFERENCE.png: three pictures in a row - yat's, the reference, and
// the absolute difference of their display values, three times as bright - and one line of figures:
//
//   RMS difference and mean of yat minus reference per channel, in levels of 255, as they are and
//   with the mean levels matched.
//
// Programs differ in exposure; the second pair of figures tells structure from level. A reference
// of another size is scaled to yat's. Exit code 1 if a picture cannot be read or written.
//
// side_by_side --size PICTURE: prints its size as WIDTHxHEIGHT.
//
// side_by_side --from-film IN.exr OUT.exr: a linear picture by LuxRender, in its film's colours
// (SMPTE-C, white .314275 .329411), as yat writes its own: linear Rec.709. For `yat diff`.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

/// RGB as floats 0..1; false, and a message, if it cannot be read.
bool read_rgb(const char* path, ImageBuf& rgb) {
  ImageBuf file(path);
  if (!file.read(0, 0, true, OIIO::TypeDesc::FLOAT)) {
    fmt::print(stderr, "{}: error: cannot be read ({})\n", path, file.geterror());
    return false;
  }
  // A grey picture is the same in all three channels.
  const std::array<int, 3> order =
      file.nchannels() >= 3 ? std::array{0, 1, 2} : std::array{0, 0, 0};
  rgb = OIIO::ImageBufAlgo::channels(file, 3, order);
  return true;
}

struct Figures {
  std::array<double, 3> mean{};
  double rms = 0;
};

/// Of a - scale * b, over all pixels.
Figures compare(const ImageBuf& a, const ImageBuf& b, const std::array<double, 3>& scale) {
  Figures f;
  const OIIO::ImageSpec& spec = a.spec();
  std::array<float, 3> p{}, q{};
  double squares = 0;
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x) {
      a.getpixel(x, y, p.data(), 3);
      b.getpixel(x, y, q.data(), 3);
      for (size_t c = 0; c < 3; ++c) {
        const double d = 255 * (double(p[c]) - scale[c] * double(q[c]));
        f.mean[c] += d;
        squares += d * d;
      }
    }
  const double n = double(spec.width) * spec.height;
  for (double& m : f.mean) m /= n;
  f.rms = std::sqrt(squares / (3 * n));
  return f;
}

std::array<double, 3> mean_of(const ImageBuf& image) {
  std::array<double, 3> mean{};
  std::array<float, 3> p{};
  for (int y = 0; y < image.spec().height; ++y)
    for (int x = 0; x < image.spec().width; ++x) {
      image.getpixel(x, y, p.data(), 3);
      for (size_t c = 0; c < 3; ++c) mean[c] += double(p[c]);
    }
  return mean;
}

/// Film colours to linear Rec.709 by way of XYZ, white not adapted; as yat has it the other way
/// round when it writes a LuxRender film (rows give red, green, blue of the film).
constexpr std::array<std::array<double, 3>, 3> kToFilm{
    {{1.04796, -.05449, -.00981}, {-.01971, 1.04063, -.01680}, {.00164, .00445, 1.00152}}};

std::array<float, 3> from_film(const std::array<float, 3>& film) {
  // Cramer's rule: the columns of the matrix, each in turn replaced by the colour.
  const auto det = [](const std::array<std::array<double, 3>, 3>& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  std::array<float, 3> rgb{};
  for (size_t c = 0; c < 3; ++c) {
    auto replaced = kToFilm;
    for (size_t row = 0; row < 3; ++row) replaced[row][c] = double(film[row]);
    rgb[c] = float(det(replaced) / det(kToFilm));
  }
  return rgb;
}

bool convert_from_film(const char* in, const char* out) {
  ImageBuf film;
  if (!read_rgb(in, film)) return false;
  ImageBuf picture(
      OIIO::ImageSpec(film.spec().width, film.spec().height, 3, OIIO::TypeDesc::FLOAT));
  std::array<float, 3> p{};
  for (int y = 0; y < film.spec().height; ++y)
    for (int x = 0; x < film.spec().width; ++x) {
      film.getpixel(x, y, p.data(), 3);
      picture.setpixel(x, y, from_film(p).data(), 3);
    }
  if (picture.write(out)) return true;
  fmt::print(stderr, "{}: error: cannot be written ({})\n", out, picture.geterror());
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--size") {
    ImageBuf picture;
    if (!read_rgb(argv[2], picture)) return 1;
    fmt::print("{}x{}\n", picture.spec().width, picture.spec().height);
    return 0;
  }
  if (argc == 4 && std::string_view(argv[1]) == "--from-film")
    return convert_from_film(argv[2], argv[3]) ? 0 : 1;
  if (argc != 4) {
    fmt::print(stderr,
               "usage: side_by_side OUT.png YAT.png REFERENCE.png, side_by_side --size PICTURE, or "
               "side_by_side --from-film IN.exr OUT.exr\n");
    return 2;
  }
  ImageBuf ours, theirs;
  if (!read_rgb(argv[2], ours) || !read_rgb(argv[3], theirs)) return 1;
  const int width = ours.spec().width, height = ours.spec().height;
  if (theirs.spec().width != width || theirs.spec().height != height)
    theirs = OIIO::ImageBufAlgo::resize(theirs, "", 0, ROI(0, width, 0, height, 0, 1, 0, 3));

  const Figures plain = compare(ours, theirs, {1, 1, 1});
  const std::array<double, 3> a = mean_of(ours), b = mean_of(theirs);
  std::array<double, 3> level{};
  for (size_t c = 0; c < 3; ++c) level[c] = b[c] > 0 ? a[c] / b[c] : 1;
  const Figures matched = compare(ours, theirs, level);

  constexpr int kGap = 8;
  ImageBuf sheet(OIIO::ImageSpec(3 * width + 2 * kGap, height, 3, OIIO::TypeDesc::FLOAT));
  const std::array<float, 3> gap{.5f, .5f, .5f};
  OIIO::ImageBufAlgo::fill(sheet, gap);
  ImageBuf difference = OIIO::ImageBufAlgo::mul(OIIO::ImageBufAlgo::absdiff(ours, theirs), 3.f);
  OIIO::ImageBufAlgo::paste(sheet, 0, 0, 0, 0, ours);
  OIIO::ImageBufAlgo::paste(sheet, width + kGap, 0, 0, 0, theirs);
  OIIO::ImageBufAlgo::paste(sheet, 2 * (width + kGap), 0, 0, 0, difference);
  if (!sheet.write(argv[1], OIIO::TypeDesc::UINT8)) {
    fmt::print(stderr, "{}: error: cannot be written ({})\n", argv[1], sheet.geterror());
    return 1;
  }
  fmt::print(
      "rms {:.1f} mean {:+.1f} {:+.1f} {:+.1f}; levels matched ({:.2f} {:.2f} {:.2f}): rms "
      "{:.1f}\n",
      plain.rms, plain.mean[0], plain.mean[1], plain.mean[2], level[0], level[1], level[2],
      matched.rms);
  return 0;
}

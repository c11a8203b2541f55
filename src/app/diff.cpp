#include "app/diff.h"

#include <fmt/format.h>

#include "metrics/flip.h"
#include "metrics/image.h"

namespace yat {
namespace {

constexpr const char* kChannels[] = {"red", "green", "blue"};

std::string figures(const ImageError& e, const Image& reference) {
  std::string text = fmt::format(
      "pixels            {} x {}, {}; mean of the reference {:.6g}\n"
      "MSE               {:.6g}\n"
      "relMSE            {:.6g}  (epsilon {:.6g})\n"
      "relMSE, trimmed   {:.6g}  (without the worst 0.1 % of pixels)\n"
      "MAPE              {:.6g}\n"
      "PSNR              {:.4g} dB  (peak {:.6g})\n"
      "mean difference   {:+.4g} %\n",
      reference.width, reference.height, reference.scene_referred ? "radiance" : "display values",
      e.mean, e.mse, e.rel_mse, e.epsilon, e.rel_mse_trimmed, e.mape, e.psnr, e.peak, 100 * e.bias);
  text += e.largest > 0 ? fmt::format("largest           {:.6g} at ({}, {}), {}\n", e.largest, e.x,
                                      e.y, kChannels[e.channel])
                        : "largest           0\n";
  text +=
      fmt::format("outliers          {} pixels brighter by more than 20 deviations\n", e.outliers);
  if (e.not_finite)
    text += fmt::format("not finite        {} pixels, left out of the figures\n", e.not_finite);
  return text;
}

}  // namespace

DiffResult diff(const DiffArguments& arguments) {
  const Image picture = read_image(arguments.picture), reference = read_image(arguments.reference);
  const ImageError error = image_error(picture, reference);
  const FlipMap seen = flip(picture, reference);
  std::optional<FlipMap> radiant;
  if (reference.scene_referred) radiant = hdr_flip(picture, reference);

  DiffResult result;
  result.text = figures(error, reference);
  result.text += fmt::format("FLIP              {:.6g}\n", seen.mean);
  if (radiant)
    result.text +=
        fmt::format("HDR-FLIP          {:.6g}  ({} exposures, {:+.2f} to {:+.2f} stops)\n",
                    radiant->mean, radiant->exposures, radiant->first_stop, radiant->last_stop);
  const FlipMap& shown = radiant ? *radiant : seen;
  if (!arguments.output.empty())
    write_map(arguments.output, shown.values, reference.width, reference.height);

  const auto exceeds = [&](const char* word, const Thresholds& t) {
    const PixelCount count = count_beyond(picture, reference, t);
    result.text += fmt::format("beyond --{:<9} {} pixels ({:.3g} %)\n", word, count.beyond_each,
                               100 * double(count.beyond_each) / double(reference.pixels()));
    if (count.beyond_any)
      result.text += fmt::format("beyond --hard{:<5} {} pixels\n", word, count.beyond_any);
    return count.fails(t, reference.pixels());
  };
  if (arguments.warn && exceeds("warn", *arguments.warn)) result.verdict = DiffVerdict::kWarned;
  bool failed = arguments.fail && exceeds("fail", *arguments.fail);
  failed = failed || (arguments.fail_rel_mse && !(error.rel_mse <= *arguments.fail_rel_mse));
  failed = failed || (arguments.fail_flip && !(shown.mean <= *arguments.fail_flip));
  if (failed) result.verdict = DiffVerdict::kFailed;
  if (arguments.fail || arguments.warn || arguments.fail_rel_mse || arguments.fail_flip)
    result.text += failed ? "FAIL\n" : result.verdict == DiffVerdict::kWarned ? "WARN\n" : "PASS\n";
  return result;
}

}  // namespace yat

#include "app/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace yat {

namespace {
constexpr double kBarInterval = 0.1, kPlainInterval = 5, kJsonInterval = 1;  // [s]
}

double ProgressState::share() const {
  double share = 0;
  if (samples_total) share = double(samples_done) / double(samples_total);
  if (time_limit > 0) share = std::max(share, seconds / time_limit);
  return std::clamp(share, 0., 1.);
}

double ProgressState::seconds_left() const {
  double left = -1;
  if (samples_total && samples_done)
    left = seconds * double(samples_total - std::min(samples_done, samples_total)) /
           double(samples_done);
  if (time_limit > 0) {
    const double until_limit = std::max(0., time_limit - seconds);
    left = left < 0 ? until_limit : std::min(left, until_limit);
  }
  return left;
}

std::string short_number(double value) {
  constexpr std::string_view kLetters[] = {"", " k", " M", " G", " T"};
  size_t thousands = 0;
  // 999.5 would print as 1000.
  while (value >= 999.5 && thousands + 1 < std::size(kLetters)) {
    value /= 1000;
    ++thousands;
  }
  const int digits = thousands == 0 && value == std::floor(value) ? 0
                     : value < 9.995                              ? 2
                     : value < 99.95                              ? 1
                                                                  : 0;
  return fmt::format("{:.{}f}{}", value, digits, kLetters[thousands]);
}

std::string short_time(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = uint64_t(std::llround(seconds));
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

namespace {
std::string numbers_of(const ProgressState& state) {
  std::string text = short_number(double(state.samples_done));
  if (state.samples_total) text += fmt::format("/{}", short_number(double(state.samples_total)));
  text += " samples";
  if (state.seconds > 0)
    text += fmt::format(", {}rays/s", [&] {
      const std::string rate = short_number(double(state.rays) / state.seconds);
      return rate.find(' ') == std::string::npos ? rate + " " : rate;
    }());
  if (const double left = state.seconds_left(); left >= 0)
    text += fmt::format(", {} left", short_time(left));
  return text;
}
}  // namespace

std::string progress_bar(const ProgressState& state, uint32_t columns) {
  const std::string numbers = numbers_of(state);
  const std::string percent = fmt::format("{:3.0f} %", std::floor(state.share() * 100));
  // "[####    ]  50 %  numbers", one column short of the edge so that no terminal wraps.
  const size_t fixed = numbers.size() + percent.size() + 6;
  const size_t room = columns > fixed + 8 ? std::min<size_t>(columns - fixed, 40) : 0;
  if (room == 0) return (percent + "  " + numbers).substr(0, columns ? columns - 1 : 0);
  const auto filled = size_t(state.share() * double(room));
  return fmt::format("[{}{}] {}  {}", std::string(filled, '#'), std::string(room - filled, ' '),
                     percent, numbers);
}

std::string progress_line(const ProgressState& state) {
  return fmt::format("{:3.0f} %  {}", std::floor(state.share() * 100), numbers_of(state));
}

std::string progress_json(const ProgressState& state, std::string_view event) {
  const double left = state.seconds_left();
  return fmt::format(
      R"({{"event":"{}","seconds":{:.3f},"samples_done":{},"samples_total":{},"rays":{},)"
      R"("rays_per_second":{:.0f},"share":{:.4f},"seconds_left":{}}})",
      event, state.seconds, state.samples_done,
      state.samples_total ? fmt::format("{}", state.samples_total) : "null", state.rays,
      state.seconds > 0 ? double(state.rays) / state.seconds : 0., state.share(),
      left >= 0 ? fmt::format("{:.3f}", left) : "null");
}

Progress::Progress(Console& console, ProgressKind kind) : console_(console), kind_(kind) {
  if (kind_ == ProgressKind::kAuto)
    kind_ = console.is_terminal() ? ProgressKind::kBar : ProgressKind::kPlain;
  // A short render needs no lines between its first and last.
  if (kind_ == ProgressKind::kPlain) next_ = kPlainInterval;
}

void Progress::show(const ProgressState& state) {
  if (kind_ == ProgressKind::kSilent || state.seconds < next_) return;
  switch (kind_) {
    case ProgressKind::kBar:
      console_.status(progress_bar(state, console_.columns()));
      next_ = state.seconds + kBarInterval;
      break;
    case ProgressKind::kJson:
      console_.line(progress_json(state, "progress"));
      next_ = state.seconds + kJsonInterval;
      break;
    default:
      console_.line(progress_line(state));
      next_ = state.seconds + kPlainInterval;
  }
}

void Progress::finish(const ProgressState& state) {
  if (kind_ == ProgressKind::kBar) console_.status({});
  if (kind_ == ProgressKind::kPlain) console_.line(progress_line(state));
  if (kind_ == ProgressKind::kJson) console_.line(progress_json(state, "done"));
}

}  // namespace yat

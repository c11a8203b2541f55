#pragma once

#include <string>

#include "converge/summary.h"

namespace yat {

/// The summary as tables of plain text, lines of up to some 110 columns; ends in a newline.
std::string converge_tables(const ConvergeSummary& summary);

/// For people: "0.0123 s", "12.3 s", "4 min 05 s"; "-" if not finite.
std::string seconds_text(double seconds);
/// "1.23 [1.20, 1.26]"; the interval only if it is known.
/// The number of samples per pixel; ~ before a mean of what a noise target took.
std::string samples_text(const RungSummary& rung);
std::string measured_text(const Measured& m);
/// "12.3 s", a tilde before it if it is extrapolated.
std::string time_text(const TimeToError& time);

}  // namespace yat

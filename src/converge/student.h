#pragma once
// Student's t distribution, for tests on few runs.

namespace yat {

/// Chance that |T| >= |t|, T of Student's distribution with df > 0 degrees of freedom (need not be
/// whole). Relative error below 1e-10 where the chance is above 1e-300. By the continued fraction
/// of the incomplete beta function (Abramowitz and Stegun 1964, 26.5.8), evaluated by Lentz's
/// method (1976).
double student_two_sided(double t, double df);

}  // namespace yat

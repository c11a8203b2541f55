#pragma once
// What materials that are made of others are tried with in test_composites.cpp: whole materials, as
// scenes give them. A new one does not compile there without a function composites(NAMEParameters).

#include "coated_cases.h"

namespace yat {

struct Composite {
  std::string name;
  std::string text;  ///< named materials; the one that is meant is "m"
  Formula f;         ///< seen from the outside, z turned to wo's side
  Formula inside;    ///< the same from the inside
  /// What single directions bring beside f, as energy, by the cosine of wo.
  std::function<glm::dvec3(double cos, bool outside)> single{nullptr};
  double index = 1;  ///< of what single directions go into
  const Formula& seen_from(double side) const { return side < 0 ? inside : f; }
};

// ---- Their parts -------------------------------------------------------------------------------

inline std::string named_material(const std::string& name, const std::string& rest) {
  return "MakeNamedMaterial \"" + name + "\" \"string type\" " + rest + "\n";
}
inline std::string mix_of(const std::string& name, const std::string& a, const std::string& b,
                          const std::string& amount) {
  return named_material(name, "[\"mix\"] \"string namedmaterial1\" [\"" + a +
                                  "\"] \"string namedmaterial2\" [\"" + b +
                                  "\"] \"float amount\" [" + amount + "]");
}
inline std::string sides_of(const std::string& name, const std::string& front,
                            const std::string& back, const std::string& more = "") {
  return named_material(name, "[\"doubleside\"] \"string frontnamedmaterial\" [\"" + front +
                                  "\"] \"string backnamedmaterial\" [\"" + back + "\"] " + more);
}
inline std::string coat_over(const std::string& base, const std::string& more) {
  return named_material("m", "[\"glossycoating\"] \"string basematerial\" [\"" + base +
                                 "\"] \"float uroughness\" [.3] \"float vroughness\" [.3] " + more);
}

inline const std::string kCompositeParts =
    named_material("white", "[\"matte\"] \"color Kd\" [1 1 1]") +
    named_material("tinted", "[\"matte\"] \"color Kd\" [.75 .5 .25]") +
    named_material("dark", "[\"matte\"] \"color Kd\" [.0625 .03125 0]") +
    named_material("rough", "[\"matte\"] \"color Kd\" [1 .5 .25] \"float sigma\" [30]") +
    named_material("sheet",
                   "[\"mattetranslucent\"] \"color Kr\" [.5 .25 0] \"color Kt\" [1 .5 .25] "
                   "\"bool energyconserving\" [\"true\"]") +
    "Texture \"alloy\" \"fresnel\" \"fresnelcolor\" \"color Kr\" [1 .5 .25]\n" +
    named_material("metal",
                   "[\"metal2\"] \"texture fresnel\" [\"alloy\"] \"float uroughness\" [.3] "
                   "\"float vroughness\" [.3]") +
    named_material("glossy",
                   "[\"glossy\"] \"color Kd\" [.75 .5 .25] \"color Ks\" [1 1 1] \"float index\" "
                   "[1.5] \"float uroughness\" [.3] \"float vroughness\" [.3]") +
    named_material("mirror", "[\"mirror\"] \"color Kr\" [1 .5 .25]") +
    named_material("glass", "[\"glass\"] \"float index\" [1.5]") +
    named_material("hole", "[\"null\"]");

inline const Formula kWhiteFormula = above_only(
    [](const glm::dvec3&, const glm::dvec3&) { return glm::dvec3(1 / std::numbers::pi); });
inline const Formula kTintedFormula = above_only([](const glm::dvec3&, const glm::dvec3&) {
  return glm::dvec3(.75, .5, .25) / std::numbers::pi;
});
inline const Formula kDarkFormula = above_only([](const glm::dvec3&, const glm::dvec3&) {
  return glm::dvec3(.0625, .03125, 0) / std::numbers::pi;
});
inline const Formula kRoughFormula = above_only([](const glm::dvec3& wo, const glm::dvec3& wi) {
  return glm::dvec3(1, .5, .25) / std::numbers::pi * oren_nayar_factor(30, wo, wi);
});
inline const Formula kSheetFormula = [](const glm::dvec3&, const glm::dvec3& wi) {
  return glm::dvec3(.5, wi.z > 0 ? .25 : .375, wi.z > 0 ? 0 : .25) / std::numbers::pi;
};
inline const Formula kMetalFormula = rough_reflection(
    LobeFormula{.3, .3}, [](double cos) { return colour_reflectance({1, .5, .25}, cos); });
inline const Formula kNoFormula = [](const glm::dvec3&, const glm::dvec3&) {
  return glm::dvec3(0);
};
inline const CoatFormula kGlossy{glm::dvec3(.75, .5, .25), glm::dvec3(1), glm::dvec3(0), 0, 1.5};

inline Formula mixed(const Formula& a, const Formula& b, double amount) {
  return [=](const glm::dvec3& wo, const glm::dvec3& wi) {
    return (1 - amount) * a(wo, wi) + amount * b(wo, wi);
  };
}

// ---- One list per kind -------------------------------------------------------------------------

inline std::vector<Composite> composites(MixParameters<Value>) {
  const auto both = [](const std::string& name, const std::string& text, const Formula& f) {
    return Composite{.name = name, .text = text, .f = f, .inside = f};
  };
  const Formula two = mixed(kTintedFormula, kRoughFormula, .25);
  std::vector<Composite> all = {
      both("two mattes", mix_of("m", "tinted", "rough", ".25"), two),
      both("matte and metal", mix_of("m", "white", "metal", ".4"),
           mixed(kWhiteFormula, kMetalFormula, .4)),
      both("nested, a sheet in it",
           mix_of("two", "tinted", "rough", ".25") + mix_of("m", "two", "sheet", ".5"),
           mixed(two, kSheetFormula, .5)),
      both("matte and mirror", mix_of("m", "tinted", "mirror", ".3"),
           mixed(kTintedFormula, kNoFormula, .3)),
      both("glass and matte", mix_of("m", "glass", "tinted", ".5"),
           mixed(kNoFormula, kTintedFormula, .5)),
      both("veil", mix_of("m", "hole", "sheet", ".4"), mixed(kNoFormula, kSheetFormula, .4)),
      // Children that give back unlike amounts of light.
      both("white and dark", mix_of("m", "white", "dark", ".75"),
           mixed(kWhiteFormula, kDarkFormula, .75)),
      both("dark veil", mix_of("m", "dark", "hole", ".4"), mixed(kDarkFormula, kNoFormula, .4)),
      both("nested, dark and mirror",
           mix_of("two", "dark", "tinted", ".25") + mix_of("m", "two", "mirror", ".5"),
           mixed(mixed(kDarkFormula, kTintedFormula, .25), kNoFormula, .5))};
  all[3].single = [](double, bool) { return .3 * glm::dvec3(1, .5, .25); };
  all[4].single = [](double, bool) { return glm::dvec3(.5); };
  all[4].index = 1.5;
  all[5].single = [](double, bool) { return glm::dvec3(.6); };
  all[7].single = [](double, bool) { return glm::dvec3(.4); };
  all[8].single = [](double, bool) { return .5 * glm::dvec3(1, .5, .25); };
  return all;
}

inline std::vector<Composite> composites(DoubleSideParameters<Value>) {
  const Formula coated = above_only([](const glm::dvec3& wo, const glm::dvec3& wi) {
    return kGlossy.coat(wo, wi, 1) + kGlossy.covered(wo, wi);
  });
  std::vector<Composite> all = {
      {"matte, metal", sides_of("m", "white", "metal"), kWhiteFormula, kMetalFormula},
      // The front shows glossy from behind, where its coat is not; so does the back from its front.
      {"turned", sides_of("m", "glossy", "glossy", "\"bool usefrontforfront\" [\"false\"]"),
       kTintedFormula, coated},
      {"mirror, matte", sides_of("m", "mirror", "rough"), kNoFormula, kRoughFormula},
      {"mixture, glass",
       mix_of("mixture", "white", "metal", ".4") +
           sides_of("m", "mixture", "glass", "\"bool usefrontforback\" [\"false\"]"),
       mixed(kWhiteFormula, kMetalFormula, .4), kNoFormula}};
  all[2].single = [](double, bool outside) {
    return outside ? glm::dvec3(1, .5, .25) : glm::dvec3(0);
  };
  all[3].single = [](double, bool outside) { return glm::dvec3(outside ? 0 : 1); };
  all[3].index = 1.5;
  return all;
}

inline std::vector<Composite> composites(CoatingParameters<Value>) {
  const CoatFormula thin{.kd = glm::dvec3(0), .ks = glm::dvec3(1), .index = 1.5};
  const CoatFormula dark{.kd = glm::dvec3(0),
                         .ks = glm::dvec3(.25, .125, .0625),
                         .ka = glm::dvec3(.5, .25, 0),
                         .depth = .5};
  const std::string thin_text = "\"color Ks\" [1 1 1] \"float index\" [1.5]",
                    dark_text =
                        "\"color Ks\" [.25 .125 .0625] \"color Ka\" [.5 .25 0] \"float d\" [.5]";
  // Light through the coat, from either side (kernels/coat.h).
  const auto passes = [](const CoatFormula& c, const glm::dvec3& wo, const glm::dvec3& wi,
                         bool outside) {
    const bool reflected = wi.z > 0;
    if (reflected && !outside) return glm::dvec3(1);
    const glm::dvec3 up(wi.x, wi.y, std::abs(wi.z));
    const double way = (outside ? 1 / wo.z : 0) + (reflected == outside ? 1 / up.z : 0);
    const glm::dvec3 rest = 1. - c.fresnel(wo, up);
    return absorption(c.ka, c.depth, way) * (reflected ? rest : glm::sqrt(rest));
  };
  const auto over = [&](const std::string& name, const std::string& text, const CoatFormula& c,
                        const Formula& base) {
    return Composite{
        .name = name,
        .text = text,
        .f =
            [=](const glm::dvec3& wo, const glm::dvec3& wi) {
              const glm::dvec3 through = passes(c, wo, wi, true) * base(wo, wi);
              return wi.z > 0 ? c.coat(wo, wi, 1) + through : through;
            },
        .inside = [=](const glm::dvec3& wo,
                      const glm::dvec3& wi) { return passes(c, wo, wi, false) * base(wo, wi); }};
  };
  const auto reflected = [=](const CoatFormula& c, const glm::dvec3& kr) {
    return [=](double cos, bool outside) {
      const glm::dvec3 w = at_cosine(cos, 0);
      return kr * passes(c, w, {-w.x, -w.y, w.z}, outside);
    };
  };
  std::vector<Composite> all = {
      over("over matte", coat_over("white", thin_text), thin, kWhiteFormula),
      over("over metal", coat_over("metal", dark_text), dark, kMetalFormula),
      over("over a sheet", coat_over("sheet", dark_text), dark, kSheetFormula),
      over("over a mirror", coat_over("mirror", dark_text), dark, kNoFormula),
      over("over a mixture",
           mix_of("mixture", "white", "mirror", ".5") + coat_over("mixture", thin_text), thin,
           mixed(kWhiteFormula, kNoFormula, .5)),
      over("over a dark mixture",
           mix_of("mixture", "dark", "tinted", ".125") + coat_over("mixture", thin_text), thin,
           mixed(kDarkFormula, kTintedFormula, .125))};
  all[3].single = reflected(dark, {1, .5, .25});
  all[4].single = reflected(thin, .5 * glm::dvec3(1, .5, .25));
  return all;
}

}  // namespace yat

// Any text is either refused with an Error or read; what is read prints to text that is read
// without a new error and prints the same again.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "scene/parse.h"

namespace {

yat::Description read(std::string_view text, yat::Diagnostics& diagnostics) {
  return yat::parse_scene(text, "fuzz.lxs", "", diagnostics, false);
}

[[noreturn]] void report(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

void check_line(yat::Severity, std::string_view line) {
  if (line.find('\n') != std::string_view::npos) report("a message of two lines");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  yat::Diagnostics diagnostics(check_line);
  yat::Description description;
  try {
    description = read({reinterpret_cast<const char*>(data), size}, diagnostics);
  } catch (const yat::Error& error) {
    check_line(yat::Severity::kError, error.what());
    return 0;
  }
  const std::string printed = yat::print_description(description);
  std::string again;
  try {
    yat::Diagnostics second(check_line);
    const yat::Description back = read(printed, second);
    if (back.shapes.size() != description.shapes.size() ||
        back.area_lights.size() != description.area_lights.size() ||
        back.instances.size() != description.instances.size())
      report("rows lost on the way through text:\n" + printed);
    for (size_t i = 0; i < back.shapes.size(); ++i)
      if (back.shapes[i].material != description.shapes[i].material ||
          back.shapes[i].area_light != description.shapes[i].area_light ||
          back.shapes[i].object != description.shapes[i].object)
        report("a shape refers to other rows after printing:\n" + printed);
    again = yat::print_description(back);
  } catch (const yat::Error& error) {
    report(std::string("printed text is refused: ") + error.what() + "\n" + printed);
  }
  if (again != printed) report("printed twice, two texts:\n" + printed + "\n----\n" + again);
  return 0;
}

#pragma once
// Reads STL meshes, ascii and binary.

#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace yat {

/// An STL file that cannot be used. what(): "mesh.stl: reason".
class StlError : public Error {
 public:
  using Error::Error;
};

/// Three corners per triangle, three numbers per corner, in the order of the file. Its normals are
/// not read: the corners' order says the outside. Throws StlError (missing, malformed, cut off).
std::vector<float> read_stl(const std::string& path);
/// The same from memory; `name` is shown in messages.
std::vector<float> parse_stl(std::string_view data, std::string_view name);

}  // namespace yat

// Any bytes are either refused with a PlyError or give a mesh that keeps its promises.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "scene/ply.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const yat::PlyMesh mesh =
        yat::parse_ply({reinterpret_cast<const char*>(data), size}, "fuzz.ply");
    const size_t vertices = mesh.vertices();
    if (mesh.triangles.empty() || mesh.triangles.size() % 3 != 0) std::abort();
    if (mesh.positions.size() != 3 * vertices) std::abort();
    if (!mesh.normals.empty() && mesh.normals.size() != 3 * vertices) std::abort();
    if (!mesh.uvs.empty() && mesh.uvs.size() != 2 * vertices) std::abort();
    for (const uint32_t index : mesh.triangles)
      if (index >= vertices) std::abort();
    // Nothing is taken on trust: what is held came from bytes that are there.
    if (mesh.positions.capacity() > 4 * size || mesh.triangles.capacity() > 8 * size) std::abort();
  } catch (const yat::PlyError&) {
  }
  return 0;
}

#pragma once
// The groups of kernels, one translation unit each. Every group fills its slots of the table.

#include "kernels/table.h"

namespace yat::YAT_ISA {

void fill_generate(KernelTable& table);           ///< draw, camera rays
void fill_surface(KernelTable& table);            ///< hits -> bins, surfaces; emission
void fill_light(KernelTable& table);              ///< light sampling, the kinds most scenes have
void fill_environment(KernelTable& table);        ///< light sampling of all kinds; rays that miss
void fill_light_tree(KernelTable& table);         ///< what scenes of many lights do instead
void fill_varying_emission(KernelTable& table);   ///< lights that do not shine evenly
void fill_diffuse_materials(KernelTable& table);  ///< shading and BSDF batches, by family
void fill_coated_materials(KernelTable& table);
void fill_layered_materials(KernelTable& table);
void fill_metal_materials(KernelTable& table);
void fill_glass_materials(KernelTable& table);
void fill_split(KernelTable& table);       ///< materials made of others; veils
void fill_textures(KernelTable& table);    ///< texture steps, per kind
void fill_accumulate(KernelTable& table);  ///< shadow rays -> samples
void fill_traverse(KernelTable& table);
void fill_quadrics(KernelTable& table);  ///< analytic shapes but whole spheres and planes, by kind
void fill_disks(KernelTable& table);
void fill_tori(KernelTable& table);
void fill_shape_tree(KernelTable& table);
void fill_instances(KernelTable& table);  ///< all that only scenes with shared objects need

}  // namespace yat::YAT_ISA

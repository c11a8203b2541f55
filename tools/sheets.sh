#!/usr/bin/env bash
# tools/sheets.sh [OPTION...] [NAME...]: renders scenes that have a picture by YART or LuxRender and puts
# yat's picture, the reference and their difference beside each other, one sheet a scene.
#
#   --scenes FOLDER  where the scenes are (YAT_SHARED_SCENES, ../shared/scenes)
#   --build FOLDER   a Release build (build/release)
#   -o FOLDER        where sheets go (build/sheets)
#   --against yart|luxrender|both   which references (both)
#   --spp N          samples per pixel (64)
#   --list           what there is, nothing rendered
#
# NAME: only the sheets whose name holds one of these texts. YART's pictures are rendered by its rules
# (--compat yart), with their own tone mapping; LuxRender's by its rules. The last lines are figures, one
# line a sheet (see tools/side_by_side.cpp), also in FOLDER/figures.txt.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
scenes=${YAT_SHARED_SCENES:-$root/../shared/scenes}
build=$root/build/release output=$root/build/sheets against=both spp=64 list=0
names=()
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      sed -n '2,/^set/{/^set/!s/^# \{0,1\}//p}' "$0"
      exit 0
      ;;
    --list) list=1 ;;
    --scenes | --build | -o | --against | --spp)
      if [ $# -lt 2 ]; then
        echo "sheets.sh: $1 needs a value" >&2
        exit 2
      fi
      case $1 in
        --scenes) scenes=$2 ;;
        --build) build=$2 ;;
        -o) output=$2 ;;
        --against) against=$2 ;;
        --spp) spp=$2 ;;
      esac
      shift
      ;;
    -*)
      echo "sheets.sh: no such option: $1 (see --help)" >&2
      exit 2
      ;;
    *) names+=("$1") ;;
  esac
  shift
done

# Reference (under yart-reference-images), scene.
yart="
tpe1/2bunnies                    StanfordBunny/2StanfordBunnies
tpe1/4bunnies                    StanfordBunny/4StanfordBunnies
tpe1/bunny                       StanfordBunny/StanfordBunny
tpe1/glass_high_ior              Benchmarks/Benchmarks/GlassHighIOR
tpe1/glass_high_transparency     Benchmarks/Benchmarks/GlassHighTransparency
tpe1/glass_low_transparency      Benchmarks/Benchmarks/GlassLowTransparency
tpe1/glass_medium_transparency   Benchmarks/Benchmarks/GlassMediumTransparency
tpe1/matte_blue                  Benchmarks/Benchmarks/MatteBlue
tpe1/matte_green                 Benchmarks/Benchmarks/MatteGreen
tpe1/matte_red                   Benchmarks/Benchmarks/MatteRed
tpe1/metal_high_roughness        Benchmarks/Benchmarks/MetalHighRoughness
tpe1/metal_low_roughness         Benchmarks/Benchmarks/MetalLowRoughness
tpe1/metal_medium_roughness      Benchmarks/Benchmarks/MetalMediumRoughness
tpe1/mirror_high_reflectivity    Benchmarks/Benchmarks/MirrorHighReflectivity
tpe1/mirror_low_reflectivity     Benchmarks/Benchmarks/MirrorLowReflectivity
tpe1/mirror_medium_reflectivity  Benchmarks/Benchmarks/MirrorMediumReflectivity
tpe2/cornell-box10000            CornellBox/cornell-box
tpe2/dragon10000                 Dragon/dragon
tpe2/goku1000                    Goku/goku
tpe2/pillar-reinhard             Pillar/pillar-reinhard
tpe2/pillar-sphere-large         Pillar/pillar-sphere-large
tpe2/pillar-sphere-small         Pillar/pillar-sphere-small
tpe2/pillar-square-large         Pillar/pillar-square-large
tpe2/pillar-square-small         Pillar/pillar-square-small
tpe2/sponza1000                  Sponza/sponza
tpe2/metal-mario                 MetalMario/metal-mario-wall
tpe3/cornell-box1000             CornellBoxFisheye/cornell-box-fisheye
tpe3/cornell-box-high1000        CornellBoxFisheye/cornell-box-fisheye-high-fov
tpe3/cornell-box-low1000         CornellBoxFisheye/cornell-box-fisheye-low-fov
tpe3/depth-of-field-control1000  DepthOfField/depth-of-field-control
tpe3/depth-of-field-high1000     DepthOfField/depth-of-field-high
tpe3/depth-of-field-low1000      DepthOfField/depth-of-field-low
tpe3/metal-mario-bg1-1000        MetalMario/metal-mario-bg1
tpe3/metal-mario-bg2-1000        MetalMario/metal-mario-bg2
tpe3/metal-mario-bg3-1000        MetalMario/metal-mario-bg3
tpe3/metal-mario-bg4-1000        MetalMario/metal-mario-bg4
"
# Reference (under luxrender-reference-images), scene, depth where it is not 10.
luxrender="
benchmarks-glass-high-transparency-path10      Benchmarks/Benchmarks/GlassHighTransparency
benchmarks-matte-blue-path10                   Benchmarks/Benchmarks/MatteBlue
benchmarks-metal-medium-roughness-path10       Benchmarks/Benchmarks/MetalMediumRoughness
benchmarks-mirror-medium-reflectivity-path10   Benchmarks/Benchmarks/MirrorMediumReflectivity
benchmarks-spheres-path10                      Benchmarks/Benchmarks/Spheres
benchmarks-textured-channels-path10            Benchmarks/Benchmarks/TexturedChannels
cornell-path10-256spp                          CornellBox/cornell-box
depth-of-field-high-path10                     DepthOfField/depth-of-field-high
dragon-202k-path10-32spp                       Dragon/dragon-202k
goku-path10                                    Goku/goku
luxcornell-path10-64spp                        LuxCornell/path
luxtime-path16-16spp                           LuxTime/luxtime  --max-depth 16
metal-mario-bg1-path10                         MetalMario/metal-mario-bg1
pillar-point-path10-64spp                      Pillar/pillar-point
pillar-sphere-large-path10                     Pillar/pillar-sphere-large
pillar-sphere-small-path10-64spp               Pillar/pillar-sphere-small
pillar-square-large-path10                     Pillar/pillar-square-large
pillar-square-small-path10-64spp               Pillar/pillar-square-small
sponza-full-lampflip-path10-32spp              Sponza/sponza-full
sponza-textured-lampflip-path10                Sponza/sponza-textured
sunsky-mid-path7                               LuxSunSky/sunsky_mid  --max-depth 7
"
if ! [ -d "$scenes" ]; then
  echo "sheets.sh: $scenes: no such folder; give --scenes FOLDER" >&2
  exit 1
fi

wanted() { # wanted NAME
  local text
  [ ${#names[@]} = 0 ] && return 0
  for text in "${names[@]}"; do [[ $1 == *"$text"* ]] && return 0; done
  return 1
}
failed=0
sheet() { # sheet KIND REFERENCE SCENE OPTION...
  local kind=$1 reference=$scenes/$1-reference-images/$2.png scene=$scenes/$3.lxs
  local name=$kind-${2//\//-}
  shift 3
  wanted "$name" || return 0
  if [ $list = 1 ]; then
    echo "$name: $scene"
    return 0
  fi
  if ! [ -r "$scene" ] || ! [ -r "$reference" ]; then
    echo "$name: left out: $scene or $reference is not there"
    return 0
  fi
  # The reference's size: YART's pictures have their scene's, LuxRender's may be smaller.
  local size
  size=$("$build/bin/side_by_side" --size "$reference")
  if ! "$build/bin/yat" render "$scene" --spp "$spp" --resolution "$size" -o "$output/$name-yat.png" \
    "$@" 2> "$output/$name.log" > /dev/null; then
    echo "$name: yat failed: $(tail -1 "$output/$name.log")" | tee -a "$output/figures.txt"
    failed=1
    return 0
  fi
  echo "$name: $("$build/bin/side_by_side" "$output/$name.png" "$output/$name-yat.png" "$reference")" |
    tee -a "$output/figures.txt"
}
mkdir -p "$output"
[ $list = 1 ] || : > "$output/figures.txt"
if [ "$against" != luxrender ]; then
  while read -r reference scene; do
    case $reference in
      '') ;;
      # The first ones are by its ray tracer, the others by its path tracer.
      tpe1/*) sheet yart "$reference" "$scene" --compat yart --max-depth 10 --integrator direct ;;
      *) sheet yart "$reference" "$scene" --compat yart --max-depth 10 ;;
    esac
  done <<< "$yart"
fi
if [ "$against" != yart ]; then
  while read -r reference scene options; do
    # shellcheck disable=SC2086 # options are words
    [ -z "$reference" ] || sheet luxrender "$reference" "$scene" ${options:---max-depth 10}
  done <<< "$luxrender"
fi
exit $failed

#!/usr/bin/env bash
# tools/sheets.sh [OPTION...] [NAME...]: renders scenes that have a picture by YART or LuxRender and puts
# yat's picture, the reference and their difference beside each other, one sheet a picture.
#
#   --scenes FOLDER  where the scenes are (YAT_SHARED_SCENES, ../shared/scenes)
#   --build FOLDER   a Release build (build/release)
#   -o FOLDER        where sheets go (build/sheets)
#   --against yart|luxrender|both   which references (both)
#   --spp N          samples per pixel (YART's: 64; LuxRender's: at least as many as the reference has)
#   --list           what there is, nothing rendered
#
# NAME: only the sheets whose name holds one of these texts. YART's pictures are rendered by its rules
# (--compat yart), with their own tone mapping; LuxRender's by its rules. Figures come one line a sheet
# (see tools/side_by_side.cpp), also in FOLDER/figures.txt: of display values, and of LuxRender's pictures
# also of the linear ones (`yat diff`: mean difference, relMSE whole and without the worst 0.1 %).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
scenes=${YAT_SHARED_SCENES:-$root/../shared/scenes}
build=$root/build/release output=$root/build/sheets against=both spp='' list=0
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
# Reference (under luxrender-reference-images), scene, samples (at least the reference's), depth where
# it is not 10.
luxrender="
benchmarks-glass-high-transparency-path10      Benchmarks/Benchmarks/GlassHighTransparency   256
benchmarks-matte-blue-path10                   Benchmarks/Benchmarks/MatteBlue               256
benchmarks-metal-medium-roughness-path10       Benchmarks/Benchmarks/MetalMediumRoughness    256
benchmarks-mirror-medium-reflectivity-path10   Benchmarks/Benchmarks/MirrorMediumReflectivity 256
benchmarks-spheres-path10                      Benchmarks/Benchmarks/Spheres                 256
benchmarks-textured-channels-path10            Benchmarks/Benchmarks/TexturedChannels        256
cornell-bidir-metropolis-64spp                 CornellBox/cornell-box                        256 --max-depth 16
cornell-path10-256spp                          CornellBox/cornell-box                        256
cornell-path10-64spp                           CornellBox/cornell-box                        256
depth-of-field-high-path10                     DepthOfField/depth-of-field-high              256
dragon-202k-path10-32spp                       Dragon/dragon-202k                            64
goku-path10                                    Goku/goku                                     256
luxcornell-path10-64spp                        LuxCornell/path                               256
luxtime-path16-16spp                           LuxTime/luxtime                               64 --max-depth 16
metal-mario-bg1-path10                         MetalMario/metal-mario-bg1                    256
pillar-point-path10-64spp                      Pillar/pillar-point                           128
pillar-sphere-large-path10                     Pillar/pillar-sphere-large                    256
pillar-sphere-small-path10-64spp               Pillar/pillar-sphere-small                    128
pillar-square-large-path10                     Pillar/pillar-square-large                    256
pillar-square-small-path10-64spp               Pillar/pillar-square-small                    128
sponza-full-lampflip-path10-32spp              Sponza/sponza-full                            128
sponza-textured-lampflip-path10                Sponza/sponza-textured                        256
stanford-bunny-yartorder-path10                StanfordBunny/StanfordBunny                   256
sunsky-mid-path7                               LuxSunSky/sunsky_mid                          256 --max-depth 7
"
# Edits (sed) of the scenes that LuxRender could not render as they are: Scale, Rotate, Translate the
# other way round. Planes and mirrored lamps, edited for LuxRender too, yat renders as they stand.
declare -A edits=(
  [stanford-bunny-yartorder-path10]='/^\tScale /{N;N;s/\(.*\)\n\(.*\)\n\(.*\)/\3\n\2\n\1/}'
)
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
  wanted "$name" || return 0
  if [ $list = 1 ]; then
    echo "$name: $scene"
    return 0
  fi
  if ! [ -r "$scene" ] || ! [ -r "$reference" ]; then
    echo "$name: left out: $scene or $reference is not there"
    return 0
  fi
  if [ -n "${edits[$2]:-}" ]; then
    local folder
    folder=$(cd "$(dirname "$scene")" && pwd)
    sed "${edits[$2]}; s|Include \"|&$folder/|" "$scene" > "$output/$name.lxs"
    scene=$output/$name.lxs
  fi
  # The reference's size: YART's pictures have their scene's, LuxRender's may be smaller.
  local size linear=${reference%.png}.exr outputs=(-o "$output/$name-yat.png") figures
  size=$("$build/bin/side_by_side" --size "$reference")
  [ ! -r "$linear" ] || outputs+=(-o "$output/$name-yat.exr")
  if ! "$build/bin/yat" render "$scene" --resolution "$size" "${outputs[@]}" "${@:4}" \
    2> "$output/$name.log" > /dev/null; then
    echo "$name: yat failed: $(tail -1 "$output/$name.log")" | tee -a "$output/figures.txt"
    failed=1
    return 0
  fi
  figures=$("$build/bin/side_by_side" "$output/$name.png" "$output/$name-yat.png" "$reference")
  if [ -r "$linear" ]; then
    "$build/bin/side_by_side" --from-film "$linear" "$output/$name-reference.exr"
    figures+=$("$build/bin/yat" diff "$output/$name-yat.exr" "$output/$name-reference.exr" | awk '
      /^mean difference/ { mean = $3 } /^relMSE  / { whole = $2 } /^relMSE, / { trimmed = $3 }
      END { printf "; linear: mean %s %%, relMSE %s, trimmed %s", mean, whole, trimmed }')
  fi
  echo "$name: $figures" | tee -a "$output/figures.txt"
}
mkdir -p "$output"
[ $list = 1 ] || : > "$output/figures.txt"
if [ "$against" != luxrender ]; then
  while read -r reference scene; do
    case $reference in
      '') ;;
      # The first ones are by its ray tracer, the others by its path tracer.
      tpe1/*) sheet yart "$reference" "$scene" --spp "${spp:-64}" --compat yart --max-depth 10 \
        --integrator direct ;;
      *) sheet yart "$reference" "$scene" --spp "${spp:-64}" --compat yart --max-depth 10 ;;
    esac
  done <<< "$yart"
fi
if [ "$against" != yart ]; then
  while read -r reference scene samples options; do
    # shellcheck disable=SC2086 # options are words
    [ -z "$reference" ] || sheet luxrender "$reference" "$scene" --spp "${spp:-$samples}" \
      ${options:---max-depth 10}
  done <<< "$luxrender"
fi
exit $failed

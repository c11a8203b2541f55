#!/usr/bin/env bash
# check_low_isa.sh CPU ISA TEST_PROGRAM...
#
# Runs the per-instruction-set tests of ISA (Isa/.../ISA) of the test programs on an emulated CPU for
# which ISA is the highest, so that these kernels, and the choice of them, are tested on what they are
# for: an instruction that the CPU lacks ends the program. Exit 77 (skipped) without a qemu-x86_64
# (package qemu-user) that knows AVX2 (7.2 or newer); without a single such test: failed.
set -euo pipefail
cpu=$1 isa=$2
shift 2

emulator=$(command -v qemu-x86_64 || command -v qemu-x86_64-static || true)
if [ -z "$emulator" ]; then
  echo "skipped: no qemu-x86_64 here (package qemu-user)"
  exit 77
fi
version=$("$emulator" --version | sed -nE '1s/.* version ([0-9]+\.[0-9]+).*/\1/p')
if [ "$(printf '%s\n' 7.2 "$version" | sort -V | head -n 1)" != 7.2 ]; then
  echo "skipped: $emulator is $version, and AVX2 is emulated from 7.2 on"
  exit 77
fi
# Emulated code runs some 30 times slower. Tests of many samples are about the formulas, which the native
# run of every instruction set covers; each kernel meets its instructions in the tests that stay.
left_out=(
  Composites.{BallsInAFurnaceAreNeverBrighter,FurnaceIsTheFormulasAndNeverBrighter}
  Composites.SamplesFollowTheSumOfTheirPartsDensities
  Determinism.SameBitsForAnyThreadsBatchTileAndSplit
  Environment.{BothWaysFindTheSameLight,DirectionsFollowTheirDensity}
  InstanceRenders.PictureIsThatOfCopies
  LightRenders.TreeAndPowerGiveTheSamePicture
  Lights.{IrradianceOfKnownShapes,SphereConeIsUniformInSolidAngleNearAndFar}
  Materials.{FurnaceIsNeverBrighterThanItsLight,SamplesFollowTheirDensity}
  Oracle.PicturesAgree
  RectangleLights.{FarOnesAreUniformInArea,IrradianceIsLambertsFromEverywhere,NearOnesAreUniformInSolidAngle}
  Renders.{FurnaceAtEveryDepth,LanesAreBusyWhileShading,SphereFurnaceAtEveryDepth,TheBackOfALampShowsTheLastMaterial}
  ShapeLights.DensitiesIntegrateToTheArea
  ShapeRenders.ThousandsOfSpheresByTheTree
  Shapes.{SpawnedRaysDoNotMeetWhatTheyLeft,SurfacesHavePositionNormalAndUv}
  ShapeTangents.AreHowThePlaceMovesWithUAndV
  Split.{ACoatOverMatteIsGlossy,EachCrossingDecidesAnew}
  TextureRenders.{EveryTexturedParameterAgreesWithTheOracle,PicturesAgreeWithTheOracle}
  Traverse.{FindsTheNearestHitInLargerSoup,FindsTheNearestHitInVoxels}
  TraverseAdversarial.{ClosedMeshes,EveryRayInEveryBox}
  TraverseLimits.ClosedMeshesAreWatertight
  TraverseTiles.CameraRaysMeetWhatStreamsMeet
  TriangleLights.{FarOnesAreUniformInArea,IrradianceIsLambertsFromEverywhere,NearOnesAreUniformInSolidAngle}
)
# QEMU 7.2 takes a gather's index register ymm4 (ymm4 alone) for none: every lane reads element 0, and
# which tests meet it depends on the compiler's choice of registers. Processors run them well, so under
# it AVX2 tests need not pass: they must end without a signal, which an instruction unknown to the CPU
# would raise.
broken_gathers=
[ "$version" != 7.2 ] || [ "$isa" != avx2 ] || broken_gathers=1
log=$(mktemp)
trap 'rm -f "$log"' EXIT
without=$(printf ':Isa/%s/*' "${left_out[@]}")
# A name that no test has any more would leave nothing out.
for test in "${left_out[@]}"; do
  grep -qE "TEST_P\(${test%%.*}, ${test#*.}\)" "$(dirname "$0")"/../tests/*.cpp ||
    { echo "$0: there is no test $test to leave out"; exit 1; }
done
ran=0 failed=0
for program in "$@"; do
  # Native: emulation is only for what is tested. Into a variable: a pipe to grep -q would end the
  # program by SIGPIPE.
  tests=$("$program" --gtest_list_tests)
  case $tests in *Isa/*) ;; *) continue ;; esac
  echo "== $(basename "$program"), $isa on $cpu"
  # Lowest first: the last one is what the program would choose on this CPU.
  highest=$("$emulator" -cpu "$cpu" "$program" --gtest_list_tests --gtest_filter='Isa/*' 2>/dev/null |
    sed -nE 's|^  .*/([a-z0-9_]+)  # .*|\1|p' | awk '!seen[$0]++ { last = $0 } END { print last }')
  if [ "$highest" != "$isa" ]; then
    echo "the program takes ${highest:-nothing} for the best of this CPU, not $isa"
    failed=1
    continue
  fi
  status=0
  "$emulator" -cpu "$cpu" "$program" --gtest_filter="Isa/*/$isa-${without#:}" >"$log" 2>&1 || status=$?
  # From 128 on a signal ended it; 1 is what GoogleTest gives for failures.
  if { [ $status -eq 0 ] && grep -qE '^\[  PASSED  \] [1-9][0-9]* test' "$log"; } ||
    { [ $status -eq 1 ] && [ -n "$broken_gathers" ] && grep -qE '^\[  FAILED  \] ' "$log"; }; then
    grep -E '^\[=+\] .* ran\.' "$log"
    [ $status -eq 0 ] || echo "failures not counted: QEMU $version gathers wrongly"
    ran=$((ran + 1))
  else
    tail -n 40 "$log"
    failed=1
  fi
done
if [ $ran -eq 0 ] && [ $failed -eq 0 ]; then
  echo "no test program has tests of $isa"
  failed=1
fi
exit $failed

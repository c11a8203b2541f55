#include "app/run.h"

#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <new>
#include <optional>

#include "app/build_info.h"
#include "app/console.h"
#include "app/converge.h"
#include "app/diff.h"
#include "app/info.h"
#include "app/interrupt.h"
#include "app/load.h"
#include "app/noise_passes.h"
#include "app/options.h"
#include "app/passes.h"
#include "app/report.h"
#include "app/yart_run.h"
#include "base/whole_file.h"
#include "film/output.h"
#include "kernels/dispatch.h"

namespace yat {

namespace {

/// Checks before the work what would only fail after it.
void check_outputs(const Arguments& arguments) {
  bool features_kept = false;
  for (const std::string& output : arguments.outputs) {
    if (!is_picture_name(output))
      throw UsageError(
          fmt::format("-o {}: unknown kind of picture; choose .png, .exr or .jpg", output));
    features_kept = features_kept || keeps_features(output);
  }
  if (arguments.features && !features_kept)
    throw UsageError("--aov: feature pictures are written into .exr files; add -o FILE.exr");
}

void tell_end(Console& console, const RenderReport& report, const Diagnostics& diagnostics,
              Verbosity verbosity) {
  if (report.interrupted) {
    console.line(fmt::format(
        "interrupted: the picture holds {:.6g} samples per pixel ({} samples in {} pixels)",
        report.samples_per_pixel(), report.samples, report.pixels()));
  }
  if (verbosity == Verbosity::kQuiet) return;
  if (report.totals.timed_out)
    console.line(fmt::format("time is up: the picture holds {:.6g} samples per pixel",
                             report.samples_per_pixel()));
  console.line(summary_text(report, verbosity));
  if (diagnostics.error_count())
    console.line(fmt::format("warning: {} error{} above: parts of the scene are not in the picture",
                             diagnostics.error_count(), diagnostics.error_count() == 1 ? "" : "s"));
  for (const std::string& output : report.outputs) console.line(fmt::format("wrote {}", output));
}

RenderReport report_of(const Arguments& arguments, const Loaded& loaded, const ThreadPool& pool) {
  RenderReport report;
  report.scene = arguments.scene;
  report.scene_hash = loaded.scene.hash;
  report.film = loaded.scene.film;
  report.integrator = loaded.integrator;
  report.sampler = loaded.plan.sampler;
  report.sample_set = loaded.plan.set_columns * loaded.plan.set_rows;
  report.colour = colour_mode(arguments);
  report.dialect = arguments.dialect;
  report.transport = loaded.plan.transport;
  report.light_sampling = loaded.plan.light_sampling;
  report.shadow_roulette = arguments.shadow_roulette;
  report.light_choice = arguments.light_choice;
  report.tree = arguments.tree;
  report.instances = arguments.instances;
  report.image_bytes = arguments.image_bytes;
  report.compensation = arguments.compensation;
  report.isa = loaded.plan.kernels->isa;
  report.lanes = loaded.plan.kernels->lanes;
  report.threads = pool.threads();
  report.time = loaded.time;
  report.scene_bytes = loaded.scene.bytes();
  return report;
}

void write_pictures(const Arguments& arguments, const RenderReport& report, const FilmParts& film) {
  PictureMetadata metadata;
  metadata.scene = report.scene;
  metadata.scene_hash = report.scene_hash;
  metadata.seed = report.transport.seed;
  metadata.samples_per_pixel = report.samples_per_pixel();
  metadata.render_seconds = report.time.render;
  metadata.isa = report.isa;
  metadata.version = kBuildInfo.version;
  if (report.totals.noise) {
    const NoiseEstimate& noise = *report.totals.noise;
    metadata.noise = PictureMetadata::Noise{noise.rel_mse, noise.low(), noise.high(), noise.epsilon,
                                            report.totals.noise_target};
  }
  const std::vector<float> rgb = film.resolve();
  const std::vector<PictureLayer> layers = film.resolve_features();
  for (const std::string& output : report.outputs) {
    // Only files that the scene asks for are written as it says; -o has its own rules.
    const PictureFile* as_asked = nullptr;
    for (const PictureFile& file : report.film.files)
      if (arguments.outputs.empty() && output.ends_with(file.extension)) as_asked = &file;
    write_picture(output, rgb, film.width(), film.height(), report.film, metadata, layers,
                  as_asked);
  }
}

ExitCode render_command(const Arguments& arguments, Console& console) {
  check_outputs(arguments);
  const KernelTable& kernels = select_kernels(arguments.isa);
  ThreadPool pool(arguments.threads);
  Diagnostics diagnostics(sink_for(console, arguments.verbosity));
  Loaded loaded;
  load(arguments, kernels, pool, console, diagnostics, loaded);
  diagnostics.flush_repeats();

  RenderReport report = report_of(arguments, loaded, pool);
  report.outputs = arguments.outputs;
  if (report.outputs.empty()) {
    for (const PictureFile& file : report.film.files)
      report.outputs.push_back(report.film.filename + file.extension);
    if (report.outputs.empty()) {
      console.line(
          "warning: the film writes no file (write_png, write_tga, write_exr): .png is "
          "written");
      report.outputs.push_back(report.film.filename + ".png");
    }
  }
  for (const std::string& output : report.outputs) require_writable(output);
  for (const std::string& file : {arguments.stats_file, arguments.trace_file})
    if (!file.empty()) require_writable(file);

  const bool to_noise = arguments.noise_target.has_value();
  require_film_memory(report.film, arguments.features, film_parts(to_noise, arguments.adaptive));
  FilmParts film(report.film.crop_width(), report.film.crop_height(), arguments.features,
                 to_noise ? 2 : 1);
  report.film_bytes = film.bytes();
  {
    InterruptGuard guard;
    // Errors and the end of an interrupted render are all that -q lets through.
    const ProgressKind kind =
        arguments.verbosity == Verbosity::kQuiet && arguments.progress == ProgressKind::kAuto
            ? ProgressKind::kSilent
            : arguments.progress;
    Progress progress(console, kind);
    const PassLimits limits = pass_limits(arguments, report.film);
    const PassContext context{loaded.scene,
                              loaded.plan,
                              pool,
                              progress,
                              guard.stop(),
                              limits.time_limit,
                              !arguments.trace_file.empty()};
    report.totals = to_noise
                        ? render_to_noise(context, limits, film)
                        : render_passes(context, limits, film[0].film, film[0].features_or_null());
    report.interrupted = guard.interrupted();
    report.time.render = report.totals.seconds;
    report.samples = film.total_samples();
    if (report.samples == 0 && report.totals.stats.paths > 0)
      throw Error(
          fmt::format("{}: error: all {} samples were dropped, no picture written: their light is "
                      "not finite or above {:.3g} W/m2/sr: use weaker lights",
                      report.scene, report.totals.stats.paths, double(kLargestSample)));
    if (report.samples == 0 && !report.interrupted && report.totals.timed_out)
      throw ResourceError(
          "error: the time was up before the first sample, no picture written: give --time more "
          "seconds or render fewer pixels");
    if (report.samples == 0) {
      console.line("interrupted before the first sample: no picture written");
      return ExitCode::kInterrupted;
    }
    // Still guarded: a second Ctrl-C ends a slow write.
    Stopwatch watch;
    write_pictures(arguments, report, film);
    report.time.write = watch.lap();
  }
  tell_end(console, report, diagnostics, arguments.verbosity);
  if (!arguments.stats_file.empty()) write_whole_file(arguments.stats_file, stats_json(report));
  if (!arguments.trace_file.empty()) write_whole_file(arguments.trace_file, trace_json(report));
  return report.interrupted ? ExitCode::kInterrupted : ExitCode::kDone;
}

ExitCode info_command(const Arguments& arguments, Console& console) {
  const KernelTable& kernels = select_kernels(arguments.isa);
  ThreadPool pool(arguments.threads);
  Diagnostics diagnostics(sink_for(console, arguments.verbosity));
  Loaded loaded;
  load(arguments, kernels, pool, console, diagnostics, loaded);
  diagnostics.flush_repeats();
  print(info_text(loaded.description, loaded.scene, loaded.plan));
  return ExitCode::kDone;
}

ExitCode diff_command(const DiffArguments& arguments) {
  const DiffResult result = diff(arguments);
  print(result.text);
  switch (result.verdict) {
    case DiffVerdict::kFailed:
      return ExitCode::kDiffers;
    case DiffVerdict::kWarned:
      return ExitCode::kDiffersALittle;
    case DiffVerdict::kWithin:
      break;
  }
  return ExitCode::kDone;
}

}  // namespace

ExitCode run(int argc, const char* const* argv) {
  // A reader that has gone and a file that grew too long are errors of a write, not ends of a
  // render.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  Console console;
  try {
    const CommandLine line = parse_command_line(argc, argv);
    switch (line.command) {
      case Command::kHelp:
        print(line.text);
        return ExitCode::kDone;
      case Command::kInfo:
        return info_command(line.arguments, console);
      case Command::kRender:
        return render_command(line.arguments, console);
      case Command::kDiff:
        return diff_command(line.diff);
      case Command::kConverge:
        return converge(parse_converge_arguments(line.converge), console);
      case Command::kYart:
        return yart_command(line.yart, console);
    }
  } catch (const UsageError& error) {
    console.line(fmt::format("yat: {}", error.what()));
    return ExitCode::kBadUsage;
  } catch (const Error& error) {
    console.line(error.what());
    return ExitCode::kBadScene;
  } catch (const ResourceError& error) {
    console.line(error.what());
    return ExitCode::kResources;
  } catch (const std::bad_alloc&) {
    console.line(
        "error: out of memory: use a smaller --resolution, fewer --threads or a smaller scene");
    return ExitCode::kResources;
  } catch (const std::exception& error) {
    // Nothing else should come here; if it does, it is named and the exit code is not 0.
    console.line(fmt::format("error: {}", error.what()));
    return ExitCode::kResources;
  }
  return ExitCode::kDone;
}

}  // namespace yat

// SPDX-FileCopyrightText: The Far-LoD authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <new>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "app/view_options.hpp"
#include "app/view_summary.hpp"
#include "console/named_files.hpp"
#include "console/run_program.hpp"
#include "farlod/error.hpp"
#include "view/bundle_files.hpp"
#include "view/exported_view.hpp"
#include "view/http_server.hpp"
#include "view/view_frame.hpp"

namespace farlod {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The name alone, also where the user writes a slash behind it.
std::string name_of(const std::filesystem::path& package) {
  return (package.has_filename() ? package : package.parent_path()).filename().string();
}

ViewReply answer(const ViewCity& city, std::string_view path, const ViewQuery& query) {
  const std::string_view file = path.empty() ? bundle_files().front().name : path;
  for (const BundleFile& page : bundle_files())
    if (page.name == file) return {.type = std::string(page.type), .body = std::string(page.bytes)};
  return city.answer(path, query);
}

void serve(const ViewCity& city, const ViewOptions& options, ViewSummary& summary) {
  std::atomic<std::uint64_t> requests = 0;
  HttpServer server(options.server, [&](std::string_view path, const ViewQuery& query) {
    ++requests;
    return answer(city, path, query);
  });
  if (options.server.address != "127.0.0.1" && options.server.address != "localhost" && options.server.address != "::1")
    fmt::print(stderr, "farlod-view: other machines that reach {} can look at this city, and keep this one at work\n",
               options.server.address);
  fmt::print("http://{}:{}/\n", options.server.address, server.port());
  if (options.run.verbosity == Verbosity::normal) fmt::print("Open this address in a browser; Ctrl-C ends the program.\n");
  std::fflush(stdout);
  const std::stop_callback stop(Interruption::token(), [&] { server.stop(); });
  const std::jthread ahead([&](const std::stop_token& stopped) { city.make_first_tiles(stopped); });
  server.run();
  summary.requests = requests;
}

void write_files(const ViewCity& city, const ViewOptions& options, ViewSummary& summary) {
  ProgressLine progress("tiles", options.run.verbosity);
  const auto tell = [&](std::size_t done, std::size_t all) {
    progress.update(done, all);
    if (Interruption::token().stop_requested()) throw Cancelled("the export was interrupted");
  };
  const bool is_page = !options.export_page.empty();
  const ExportedView exported =
      is_page ? export_page(city, options.export_page, tell) : export_view(city, options.export_folder, tell);
  const std::string name = (is_page ? options.export_page : options.export_folder).string();
  if (options.run.verbosity == Verbosity::normal)
    fmt::print("{}: {} tiles, {:.1f} MiB. {}\n", name, exported.tiles, static_cast<double>(exported.bytes) / (1 << 20),
               is_page ? "A browser opens it from the disk"
                       : "It is seen by a web server only: python3 -m http.server --directory " + name);
  summary.tiles = exported.tiles;
  summary.bytes = exported.bytes;
}

std::vector<ResultLayer> read_results(const ViewOptions& options, const Package& package, const ViewFrame& frame) {
  std::vector<ResultLayer> layers;
  for (const std::string& request : options.results) layers.push_back(read_result_layer(request, package, frame));
  return layers;
}

/// An older export is replaced, and no other folder.
void require_folder_of_export(const std::filesystem::path& folder) {
  std::error_code unread;
  if (folder.empty() || !std::filesystem::exists(folder, unread)) return;
  if (!std::filesystem::is_directory(folder, unread)) throw OutputError(folder, "it is a file; choose another name for --export");
  if (!std::filesystem::is_empty(folder, unread) && !std::filesystem::exists(folder / "tileset.json", unread))
    throw OutputError(folder, "it holds other files; choose a new folder for --export");
}

void require_outputs(const ViewOptions& options) {
  require_folder_of_export(options.export_folder);
  std::vector<NamedFile> inputs;
  for (const std::string& result : options.results) inputs.push_back({"the result " + result, result});
  const std::array<NamedOutput, 3> outputs{{{{"--export", options.export_folder}, true},
                                            {{"--export", options.export_page}},
                                            {{"--summary", options.run.summary_file}}}};
  require_writable(outputs, {inputs, options.package});
}

/// What can be known before anything is computed.
void require_room(const ViewOptions& options, const Package& package) {
  if (!options.export_page.empty()) require_page_is_possible(options.export_page, package.description().triangles);
}

int run(const ViewOptions& options) {
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, thread_count(options.run));
  require_outputs(options);
  const auto start = Clock::now();
  const Package package(options.package);
  require_room(options, package);
  const ViewFrame frame = view_frame_of(package);
  const ViewCity city(package, name_of(options.package), frame, placed_on_globe(package.description(), frame),
                      read_results(options, package, frame));
  ViewSummary summary{.open_seconds = seconds_since(start)};
  const bool is_served = options.export_folder.empty() && options.export_page.empty();
  is_served ? serve(city, options, summary) : write_files(city, options, summary);
  summary.total_seconds = seconds_since(start);
  write_text(options.run.summary_file, view_summary_json(summary, options.run.settings_json));
  return Interruption::signal() == 0 ? exit_done : Interruption::exit_code();
}

}  // namespace
}  // namespace farlod

int main(int argc, char** argv) {
  using namespace farlod;
  const Interruption interruption;
  return run_program(
      {.name = "farlod-view", .when_interrupted = "Nothing was written.", .when_out_of_memory = "Use fewer --threads."}, [&] {
        const ParsedViewOptions parsed = parse_view_options(argc, argv);
        return parsed.options ? run(*parsed.options) : parsed.exit_code;
      });
}

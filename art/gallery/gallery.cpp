#include "art/gallery/gallery.h"

#include "art/gallery/batch.h"
#include "art/gallery/record.h"
#include "art/gallery/summary.h"
#include "art/image/image_file.h"
#include "art/print/format.h"
#include "art/prints.h"
#include "engine/base/text.h"
#include "engine/base/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace sikku {
namespace {

/// Bytes of a job in the list of all jobs.
constexpr double job_bytes = 700;

/// Calls `work` with every number below `count`, on several threads.
template <typename Work>
void for_each_number(std::size_t count, int threads, const Monitor& monitor, const Work& work) {
    on_threads(threads, [&] {
        for_each_index(count, [&](std::size_t i) {
            monitor.check();
            work(i);
        });
    });
}

/// The sheets that were requested.
std::vector<SheetRequest> sheets_of(const GalleryRequest& request, int threads, double memory) {
    std::vector<SheetRequest> sheets;
    if (!request.contact.empty()) sheets.push_back({"contact", request.contact, false, threads, memory});
    if (!request.poster.empty()) sheets.push_back({"poster", request.poster, true, threads, memory});
    return sheets;
}

/// True if the job uses the module for pictures.
bool uses_module(const GalleryJob& job) {
    const auto format = print_format(job.file());
    return &job.interpreter() == &prints() && format && uses_image_module(*format);
}

/// The page and the sheets: remade if their contents have changed.
class Summaries {
public:
    Summaries(const std::vector<GalleryJob>& jobs, const std::map<std::size_t, FinishedJob>& finished,
              const GalleryFolder& folder, GalleryRecord& record, const GalleryOptions& options,
              GalleryListener& listener, const Monitor& monitor)
        : folder_(folder), record_(record), options_(options), listener_(listener), monitor_(monitor) {
        for (const auto& [job, result] : finished) {
            jobs_.push_back(&jobs[job]);
            held_.add_piece(result.file);
            held_.add_piece(result.hash);
        }
    }

    /// @param order   receives the sheets that exist in the end
    /// @param result  receives warnings, and errors of the other sheets
    void make(const GalleryRequest& request, double memory, std::vector<FinishedJob>& order, GalleryResult& result) {
        const auto draw = [&](bool posters) {
            for (const SheetRequest& sheet : sheets_of(request, options_.threads, memory)) {
                if (sheet.is_poster != posters) continue;
                for (const std::string& file : sheet_files(sheet)) {
                    make(file, sheet.size, order, result,
                         [&](const std::filesystem::path& path, Destination& destination, FinishedJob& finished) {
                             std::string missing = draw_gallery_sheet(jobs_, sheet, path, destination, monitor_);
                             if (!missing.empty()) finished.warnings.push_back(std::move(missing));
                         });
                }
            }
        };
        draw(false);
        make("index.html", request.title, order, result,
             [&](const std::filesystem::path& path, Destination& destination, FinishedJob&) {
                 write_gallery_index(jobs_, request.title, path, destination, monitor_);
             });
        draw(true);
    }

private:
    template <typename Make>
    void make(const std::string& name, const std::string& setting, std::vector<FinishedJob>& order,
              GalleryResult& result, const Make& make_it) {
        FinishedJob file;
        file.file = name;
        TextHash hash = held_;
        hash.add_piece(SIKKU_VERSION);
        hash.add_piece(name);
        hash.add_piece(setting);
        file.hash = hash.digits();
        file.job = fmt::format("{{\"summary\":{}}}", json_string(setting));
        if (!options_.force) {
            if (auto known = record_.finished(name, file.hash)) {
                order.push_back(std::move(*known));
                return;
            }
        }
        listener_.sheet(name);
        try {
            const bool is_ours =
                name == "index.html" ? is_gallery_page(folder_.read(name, 4096)) : record_.is_ours(name);
            MadeFile made = make_gallery_file(record_, folder_, std::move(file), options_.force || is_ours, make_it);
            publish_gallery_file(record_, made);
            order.push_back(std::move(made.file));
            for (const std::string& text : order.back().warnings) {
                result.warnings.push_back(fmt::format("{}: {}", name, text));
            }
        } catch (const Stopped&) {
            listener_.end();
            throw;
        } catch (const std::exception& error) {
            result.troubles.push_back(fmt::format("{} failed: {}", name, error.what()));
        }
        listener_.end();
    }

    std::vector<const GalleryJob*> jobs_;  ///< jobs whose files exist
    TextHash held_;
    const GalleryFolder& folder_;
    GalleryRecord& record_;
    const GalleryOptions& options_;
    GalleryListener& listener_;
    Monitor monitor_;
};

}  // namespace

Gallery::Gallery(GalleryRequest request, GalleryOptions options, const GalleryKeys& keys, const Monitor& monitor)
    : request_(std::move(request)), options_(std::move(options)), monitor_(monitor) {
    request_.monitor = monitor;
    jobs_ = gallery_jobs(request_, keys);
    forecasts_.resize(jobs_.size());
    select();
    const bool has_module =
        std::any_of(chosen_.begin(), chosen_.end(), [&](std::size_t job) { return uses_module(jobs_[job]); });
    const double base = base_memory(has_module) + static_cast<double>(jobs_.size()) * job_bytes;
    memory_ = std::max(options_.memory - base, options_.memory / 8);
}

void Gallery::forecast_all(const std::vector<std::size_t>& wanted) {
    for_each_number(wanted.size(), options_.threads, monitor_, [&](std::size_t i) {
        std::optional<JobForecast>& forecast = forecasts_[wanted[i]];
        if (!forecast) forecast = forecast_job(jobs_[wanted[i]], options_.exact);
    });
}

const JobForecast& Gallery::forecast(std::size_t job) {
    if (!forecasts_[job]) forecast_all(chosen_);
    return *forecasts_[job];
}

void Gallery::select() {
    chosen_.resize(jobs_.size());
    std::iota(chosen_.begin(), chosen_.end(), std::size_t{0});
    if (options_.shard.count > 1) {
        std::vector<double> costs;
        forecast_all(chosen_);
        for (const auto& forecast : forecasts_) costs.push_back(forecast->own_seconds());
        const std::vector<std::size_t> shards = balance(costs, options_.shard.count);
        std::erase_if(chosen_, [&](std::size_t job) { return shards[job] + 1 != options_.shard.index; });
    }
    if (options_.only.empty()) return;
    for (const std::string& name : options_.only) {
        const auto is_named = [&](const GalleryJob& job) { return job.name == name || job.file() == name; };
        if (std::any_of(jobs_.begin(), jobs_.end(), is_named)) continue;
        std::vector<std::string_view> names;
        for (const GalleryJob& job : jobs_) names.push_back(job.name);
        throw SettingError("only", name, "no such job" + did_you_mean(nearest(name, names)));
    }
    const std::set<std::string> only(options_.only.begin(), options_.only.end());
    std::erase_if(chosen_, [&](std::size_t job) {
        return !only.contains(jobs_[job].name) && !only.contains(jobs_[job].file());
    });
}

std::vector<std::pair<std::string, JobForecast>> Gallery::sheet_forecasts(
    const std::vector<const GalleryJob*>& jobs) const {
    std::vector<std::pair<std::string, JobForecast>> forecasts;
    // Runs for a part of the jobs do not make sheets.
    if (chosen_.size() != jobs_.size()) return forecasts;
    for (const SheetRequest& sheet : sheets_of(request_, options_.threads, memory_)) {
        for (const std::string& file : sheet_files(sheet)) {
            JobForecast forecast;
            try {
                forecast.cost.memory = gallery_sheet_memory(jobs, sheet, file);
                forecast.problem = too_much_memory(forecast, memory_);
            } catch (const std::exception& error) {
                forecast.problem = error.what();
            }
            forecasts.emplace_back(file, std::move(forecast));
        }
    }
    return forecasts;
}

GalleryResult Gallery::make(GalleryListener& listener) {
    GalleryResult result;
    const Shard& shard = options_.shard;
    const GalleryFolder folder(options_.folder);
    result.record = folder.shown(shard.record_name());
    bool is_waiting = false;
    GalleryRecord record(folder, shard.record_name(), options_.force, [&] {
        if (monitor_.stop_requested()) throw Stopped("interrupted while waiting for another run; nothing was made");
        if (!std::exchange(is_waiting, true)) listener.wait_for_record(result.record);
    });
    std::vector<std::string> hashes(jobs_.size());
    for_each_number(chosen_.size(), options_.threads, monitor_,
                    [&](std::size_t i) { hashes[chosen_[i]] = jobs_[chosen_[i]].hash(); });
    std::vector<std::size_t> pending;
    const bool redo = options_.force || !options_.only.empty();
    for (const std::size_t job : chosen_) {
        auto known = redo ? std::nullopt : record.finished(jobs_[job].file(), hashes[job]);
        if (known) {
            result.finished.emplace(job, std::move(*known));
        } else {
            pending.push_back(job);
        }
    }
    forecast_all(pending);
    std::vector<Task> tasks;
    tasks.reserve(pending.size());
    for (const std::size_t job : pending) tasks.push_back({job, *forecasts_[job], false});
    for (const std::size_t job : pending) {
        if (uses_module(jobs_[job])) prepare_images(thread_count(options_.threads));
    }
    Batch batch(
        jobs_, hashes, folder, record,
        {.threads = options_.threads, .replaces = options_.force, .redoes = redo, .keep_going = options_.keep_going},
        listener, monitor_);
    if (!tasks.empty()) batch.run(std::move(tasks), memory_);
    result.finished.insert(batch.found.begin(), batch.found.end());
    for (auto& [job, finished] : batch.finished) {
        result.made.push_back(job);
        result.finished.emplace(job, std::move(finished));
    }
    result.failures = std::move(batch.failures);
    result.left = batch.left();

    std::vector<FinishedJob> order;
    const std::set<std::size_t> is_chosen(chosen_.begin(), chosen_.end());
    for (std::size_t job = 0; job < jobs_.size(); ++job) {
        if (const auto found = result.finished.find(job); found != result.finished.end()) {
            order.push_back(found->second);
        } else if (shard.count == 1 && !is_chosen.contains(job)) {
            if (auto known = record.present(jobs_[job].file())) order.push_back(std::move(*known));
        }
    }
    const bool is_whole = shard.count == 1 && options_.only.empty();
    if (is_whole && !monitor_.stop_requested() && !result.finished.empty() &&
        (result.failures.empty() || options_.keep_going)) {
        try {
            Summaries summaries(jobs_, result.finished, folder, record, options_, listener, monitor_);
            summaries.make(request_, memory_, order, result);
        } catch (const Stopped&) {
        }
    }
    try {
        record.complete(order, batch.begun, shard.count == 1);
    } catch (const std::exception& error) {
        result.troubles.push_back(error.what());  // the lines appended so far remain valid
    }
    return result;
}

}  // namespace sikku

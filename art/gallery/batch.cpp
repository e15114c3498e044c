#include "art/gallery/batch.h"

#include "art/print/format.h"
#include "engine/base/text.h"
#include "engine/base/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <new>
#include <span>
#include <stdexcept>

namespace sikku {
namespace {

/// Pictures are written by a library whose pool of threads must not grow while several are open; it has this size
/// from the beginning.
constexpr int most_picture_threads = 3;

/// The reason for a failure; never empty.
std::string problem_of(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error)) return "there is not enough memory for this";
    return *error.what() ? error.what() : "unknown error";
}

}  // namespace

std::string too_much_memory(const JobForecast& forecast, double memory) {
    if (forecast.own_memory() <= memory) return "";
    return fmt::format("it needs about {} of memory, more than is available ({})", bytes_text(forecast.own_memory()),
                       bytes_text(memory));
}

void Batch::run(std::vector<Task> tasks, double memory) {
    const auto order = [&](const Task& task) {
        const bool is_begun = record_.is_begun(jobs_[task.job].file());
        return std::pair(is_begun, is_begun ? task.forecast.own_seconds() : -task.forecast.own_seconds());
    };
    std::vector<std::pair<std::pair<bool, double>, std::size_t>> places;
    for (std::size_t i = 0; i < tasks.size(); ++i) places.emplace_back(order(tasks[i]), i);
    std::sort(places.begin(), places.end());
    double cost = 0;
    for (const auto& [place, task] : places) {
        waiting_.push_back(tasks[task]);
        cost += tasks[task].forecast.own_seconds();
    }
    listener_.begin(tasks.size(), cost);
    free_ = memory_ = memory;
    workers_ = thread_count(options_.threads);
    Publisher publisher(record_);
    publisher_ = &publisher;
    on_threads(workers_, [&] { for_each_index(static_cast<std::size_t>(workers_), [&](std::size_t) { work(); }); });
    publisher.finish();
    listener_.end();
    std::sort(failures.begin(), failures.end(), [](const Failure& a, const Failure& b) { return a.job < b.job; });
}

/// Finds the first job that fits in memory and that no other run is making; nullopt if no job is left to begin.
std::optional<Batch::Turn> Batch::next() {
    while (true) {
        const bool is_asked = monitor_.stop_requested();  // may call Python, which takes its time
        std::unique_lock lock(mutex_);
        if (stopped_ || is_asked || waiting_.empty()) return std::nullopt;
        for (auto task = waiting_.begin(); task != waiting_.end(); ++task) {
            if (task->forecast.own_memory() > free_ && under_way_ > 0) continue;
            if (!record_.take(jobs_[task->job].file())) {
                task->was_busy = true;
                continue;
            }
            Turn turn{*task, 1, task->forecast.own_memory()};
            // Towards the end there are fewer jobs than cores.
            const auto others = static_cast<int>(std::min<std::size_t>(waiting_.size() + under_way_, 1024));
            turn.threads = std::max(1, workers_ / std::max(1, others));
            if (others > 1) turn.threads = std::min(turn.threads, most_picture_threads);
            const double more = task->forecast.own_memory() + turn.threads * task->forecast.cost.band;
            if (turn.threads > 1 && more <= free_) {
                turn.memory = more;
            } else {
                turn.threads = 1;
            }
            free_ -= turn.memory;
            ++under_way_;
            waiting_.erase(task);
            return turn;
        }
        if (under_way_ == 0) tell_waiting();
        changed_.wait_for(lock, std::chrono::milliseconds(200));
    }
}

void Batch::tell_waiting() {
    if (!std::exchange(told_waiting_, true)) listener_.wait_for_jobs(waiting_.size());
}

void Batch::work() {
    try {
        while (const auto turn = next()) {
            make(*turn);
            changed_.notify_all();
            listener_.finish(turn->task.forecast.own_seconds());
        }
    } catch (...) {
        // After an error such as a failed lock, the other threads end, too.
        {
            const std::lock_guard guard(mutex_);
            stopped_ = true;
        }
        changed_.notify_all();
        throw;
    }
}

void Batch::make(const Turn& turn) {
    const GalleryJob& job = jobs_[turn.task.job];
    std::optional<MadeFile> made;
    std::optional<FinishedJob> other;
    std::string problem;
    bool is_begun = false;
    try {
        // Another run may have made it, or have begun it and been killed.
        if (turn.task.was_busy || folder_.status(job.file())) {
            record_.refresh();
            if (!options_.redoes) other = record_.finished(job.file(), hashes_[turn.task.job]);
        }
        if (!other) made = make_job(turn);
    } catch (const Stopped&) {
        is_begun = true;
    } catch (const std::exception& error) {
        problem = problem_of(error);
    }
    {
        const std::lock_guard guard(mutex_);
        free_ += turn.memory;
        --under_way_;
        if (other) found.emplace(turn.task.job, std::move(*other));
        if (is_begun) begun.push_back(job.file());
        if (!problem.empty()) fail(turn.task.job, std::move(problem));
    }
    if (!made) return record_.release(job.file());
    try {
        publisher_->add(std::move(*made), [this, turn](FinishedJob file, std::string why) {
            take(turn, std::move(file), std::move(why));
        });
    } catch (const std::exception& error) {
        record_.release(job.file());
        const std::lock_guard guard(mutex_);
        fail(turn.task.job, problem_of(error));
    }
}

/// Takes a file that has appeared, or a problem for which it has not.
void Batch::take(const Turn& turn, FinishedJob file, std::string problem) {
    record_.release(file.file);
    {
        const std::lock_guard guard(mutex_);
        if (problem.empty()) {
            finished.emplace(turn.task.job, std::move(file));
        } else {
            fail(turn.task.job, std::move(problem));
        }
    }
    changed_.notify_all();
}

/// Call with the lock.
void Batch::fail(std::size_t job, std::string problem) {
    failures.push_back({job, std::move(problem)});
    stopped_ = stopped_ || !options_.keep_going;
}

namespace {

/// True for a warning that an option of pictures has no effect on this file, if pictures of the pattern are made,
/// too.
bool is_meant_for_another(const Remark& remark, const GalleryJob& job, std::span<const GalleryJob> jobs) {
    if (remark.option != "dpi" && remark.option != "compression" && remark.option != "icc") return false;
    return std::any_of(jobs.begin(), jobs.end(), [&](const GalleryJob& other) {
        const auto format = print_format(other.file());
        return other.name == job.name && format && info(*format).kind == FormatKind::pixels;
    });
}

}  // namespace

MadeFile Batch::make_job(const Turn& turn) {
    const GalleryJob& job = jobs_[turn.task.job];
    if (!job.pattern->text) throw std::runtime_error(job.pattern->problem);
    const std::string too_much = too_much_memory(turn.task.forecast, memory_);
    if (!too_much.empty()) throw std::runtime_error(too_much);
    FinishedJob result;
    result.file = job.file();
    result.hash = hashes_[turn.task.job];
    result.job = job.text();
    const auto make = [&](const std::filesystem::path& path, Destination& destination, FinishedJob& file) {
        const Monitor monitor([](void* batch) { return static_cast<Batch*>(batch)->monitor_.stop_requested(); },
                              [](void* batch, std::uint64_t) { static_cast<Batch*>(batch)->listener_.watch(); },
                              this);
        const auto documents = job.pattern->piece ? job.pattern->piece->documents : std::vector{job.document()};
        for (const Document& document : documents) {
            for (const Diagnostic& warning : document.warnings()) {
                // Several parts may play the same pattern.
                const std::string text = warning.text();
                if (std::find(file.warnings.begin(), file.warnings.end(), text) == file.warnings.end())
                    file.warnings.push_back(text);
            }
        }
        const auto work = job.work();
        job.works->forget(job.file());
        for (Remark& remark : work->make(destination, path, monitor, turn.threads).remarks) {
            if (is_meant_for_another(remark, job, jobs_)) continue;
            (remark.is_warning ? file.warnings : file.told).push_back(std::move(remark.text));
        }
    };
    const bool replaces = options_.replaces || record_.is_ours(result.file);
    return make_gallery_file(record_, folder_, std::move(result), replaces, make);
}

}  // namespace sikku

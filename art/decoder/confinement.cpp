#include "art/decoder/confinement.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

void check(bool holds) {
    if (!holds) throw std::runtime_error(std::generic_category().message(errno));
}

/// Lowers a limit, which never exceeds that of the user.
void limit(__rlimit_resource resource, std::uint64_t soft, std::uint64_t hard) {
    rlimit known{};
    check(::getrlimit(resource, &known) == 0);
    const rlim_t most = std::min<rlim_t>(hard, known.rlim_max);
    const rlimit lower = {std::min({static_cast<rlim_t>(soft), known.rlim_cur, most}), most};
    check(::setrlimit(resource, &lower) == 0);
}

#ifndef SIKKU_SANITIZED

/// Bytes of address space that the process has now.
std::uint64_t used_memory() {
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    if (pages == 0) throw std::runtime_error("/proc cannot be read");
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;
#endif

/// System calls for memory, threads, clocks, and for reading and writing open files. None names a file, a process
/// or a network address.
constexpr std::uint32_t permitted_calls[] = {
    // open files
    SYS_read, SYS_write, SYS_readv, SYS_writev, SYS_pread64, SYS_lseek, SYS_fstat, SYS_close,
    // memory
    SYS_mmap, SYS_munmap, SYS_mremap, SYS_mprotect, SYS_madvise, SYS_brk,
    // threads
    SYS_futex, SYS_set_robust_list, SYS_rseq, SYS_exit, SYS_exit_group, SYS_sched_yield, SYS_sched_getaffinity,
    SYS_getcpu,
    // clocks
    SYS_clock_gettime, SYS_clock_getres, SYS_clock_nanosleep, SYS_nanosleep, SYS_gettimeofday,
    // signals of this process
    SYS_rt_sigaction, SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_sigaltstack, SYS_restart_syscall,
    // facts about this process and the system
    SYS_getpid, SYS_gettid, SYS_getrandom, SYS_sysinfo, SYS_uname, SYS_getrusage, SYS_membarrier};

/// Refuses all other system calls with EPERM. Threads can be started, processes cannot. Source: seccomp(2), bpf(4).
/// @returns false if the kernel does not support filters
bool filter_calls() {
    if (architecture == 0) return true;
    constexpr auto word = [](std::size_t at) {
        return sock_filter{BPF_LD | BPF_W | BPF_ABS, 0, 0, static_cast<std::uint32_t>(at)};
    };
    // Skips as many instructions as `then` or `otherwise` says.
    constexpr auto jump = [](std::uint16_t kind, std::uint32_t value, std::uint8_t then, std::uint8_t otherwise) {
        return sock_filter{static_cast<std::uint16_t>(BPF_JMP | kind | BPF_K), then, otherwise, value};
    };
    constexpr auto answer = [](std::uint32_t value) { return sock_filter{BPF_RET | BPF_K, 0, 0, value}; };
    constexpr std::uint32_t refused = SECCOMP_RET_ERRNO | EPERM;
    // Programs fall back to the older call, whose flags a filter can read.
    constexpr std::uint32_t unknown = SECCOMP_RET_ERRNO | ENOSYS;
    constexpr std::uint32_t thread_flag = 0x00010000;  // CLONE_THREAD
    std::vector<sock_filter> program = {
        word(offsetof(seccomp_data, arch)),
        jump(BPF_JEQ, architecture, 1, 0),
        answer(SECCOMP_RET_KILL_PROCESS),
        word(offsetof(seccomp_data, nr)),
        jump(BPF_JEQ, SYS_clone3, 0, 1),
        answer(unknown),
        jump(BPF_JEQ, SYS_clone, 0, 4),
        word(offsetof(seccomp_data, args)),  // the lower half: both architectures
                                             // are little-endian
        jump(BPF_JSET, thread_flag, 0, 1),
        answer(SECCOMP_RET_ALLOW),
        answer(refused),
    };
    for (const std::uint32_t call : permitted_calls) {
        program.push_back(jump(BPF_JEQ, call, 0, 1));
        program.push_back(answer(SECCOMP_RET_ALLOW));
    }
    program.push_back(answer(refused));
    const sock_fprog filter = {static_cast<unsigned short>(program.size()), program.data()};
    return ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter) == 0;
}

#endif

/// Closes all descriptors but the standard ones; one by one where the kernel cannot do it in one call.
void close_others() {
    if (::syscall(SYS_close_range, 3U, ~0U, 0U) == 0) return;
    rlimit most{};
    check(::getrlimit(RLIMIT_NOFILE, &most) == 0);
    for (rlim_t descriptor = 3; descriptor < most.rlim_max && descriptor < 1'048'576; ++descriptor) {
        ::close(static_cast<int>(descriptor));
    }
}

/// Threads of decoders, one for each core, would reserve 8 MB each.
void use_small_stacks() {
    pthread_attr_t attributes;
    if (::pthread_attr_init(&attributes) != 0) return;
    ::pthread_attr_setstacksize(&attributes, std::size_t{1} << 20U);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
}

}  // namespace

void confine(const ConfinementLimits& limits, int parent) {
    check(::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0);
    if (::getppid() != parent) ::_exit(1);
    check(::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0);
    close_others();
    use_small_stacks();
    limit(RLIMIT_FSIZE, 0, 0);
    // The first limit ends the process by a signal that names the reason, the second in any case.
    limit(RLIMIT_CPU, limits.seconds, limits.seconds + 1);
#ifndef SIKKU_SANITIZED  // sanitizers reserve terabytes and open files
    const std::uint64_t memory = used_memory() + limits.memory;
    limit(RLIMIT_AS, memory, memory);
    limit(RLIMIT_NOFILE, 3, 3);
#endif
    // Files, and dumps that the system pipes to a program.
    limit(RLIMIT_CORE, 0, 0);
    check(::prctl(PR_SET_DUMPABLE, 0) == 0);
#ifndef SIKKU_SANITIZED
    filter_calls();
#endif
}

}  // namespace sikku

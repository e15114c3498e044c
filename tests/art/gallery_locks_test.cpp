// tests/art/gallery_locks_test.cpp: locks on file systems that deny them.
#include "art/gallery/folder.h"
#include "art/gallery/locks.h"
#include "tests/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>

namespace sikku::gallery_locks_test {

/// Makes the system answer all locks of this process with an error. False if it cannot.
bool deny_locks(int error) {
    constexpr std::uint32_t allow = SECCOMP_RET_ALLOW;
    std::array<sock_filter, 7> program = {{
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
        {BPF_JMP | BPF_JEQ | BPF_K, 0, 4, SYS_fcntl},
        {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, args) + sizeof(std::uint64_t)},
        {BPF_JMP | BPF_JGE | BPF_K, 0, 2, F_OFD_GETLK},
        {BPF_JMP | BPF_JGT | BPF_K, 1, 0, F_OFD_SETLKW},
        {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error)},
        {BPF_RET | BPF_K, 0, 0, allow},
    }};
    const sock_fprog filter = {program.size(), program.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

/// Galleries once took EACCES for a lock of another run, and waited forever.
TEST(GalleryLocks, LocksThatAreDeniedAreNotThoseOfAnotherRun) {
    for (const int error : {EACCES, ENOLCK}) {
        const ScratchFolder folder;
        const ::pid_t child = ::fork();
        if (child == 0) {
            ::alarm(20);
            if (!deny_locks(error)) ::_exit(2);
            const GalleryFolder gallery(folder.path());
            GalleryLocks locks(gallery);
            ::_exit(locks.work() ? 1 : 0);
        }
        int state = 0;
        ASSERT_EQ(::waitpid(child, &state, 0), child);
        ASSERT_TRUE(WIFEXITED(state)) << WTERMSIG(state);
        if (WEXITSTATUS(state) == 2) GTEST_SKIP() << "the kernel has no filters for system calls";
        EXPECT_EQ(WEXITSTATUS(state), 0) << error;
    }
}

}  // namespace sikku::gallery_locks_test

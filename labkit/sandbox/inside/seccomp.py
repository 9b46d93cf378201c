"""Linux's filter of system calls: what student code has no use for is refused.

No process, signal, socket, memory file, lock or attribute of a file, no other process's
limits, nothing of which the whole system has only so much.
It closes what Landlock leaves open, and holds for root too. Source: seccomp(2),
<linux/filter.h>, <asm/unistd.h>. Where the processor is another one, there is none.
"""

import ctypes
import platform
import sys

# Name, its number on x86-64, its number on 64-bit ARM (- where it has none).
_REFUSED = """
clone 56 220          clone3 435 435          fork 57 -               vfork 58 -
execve 59 221         execveat 322 281        kill 62 129             tkill 200 130
tgkill 234 131        rt_sigqueueinfo 129 138 rt_tgsigqueueinfo 297 240
pidfd_open 434 434    pidfd_send_signal 424 424   pidfd_getfd 438 438
ptrace 101 117        process_vm_readv 310 270    process_vm_writev 311 271
process_madvise 440 440   process_mrelease 448 448    kcmp 312 272
socket 41 198         socketpair 53 199       connect 42 203          bind 49 200
listen 50 201         accept 43 202           accept4 288 242
memfd_create 319 279  memfd_secret 447 447    shmget 29 194           semget 64 190
msgget 68 186         mq_open 240 180         io_uring_setup 425 425
userfaultfd 323 282   perf_event_open 298 241 bpf 321 280
io_setup 206 0        timer_create 222 107    flock 73 32
sync 162 81           syncfs 306 267
setpriority 141 140   ioprio_set 251 30       sched_setaffinity 203 122
sched_setattr 314 274 sched_setparam 142 118  sched_setscheduler 144 119
migrate_pages 256 238 move_pages 279 239
chmod 90 -            fchmod 91 52            fchmodat 268 53         chown 92 -
fchown 93 55          lchown 94 -             fchownat 260 54         utime 132 -
utimes 235 -          futimesat 261 -         utimensat 280 88        setxattr 188 5
lsetxattr 189 6       fsetxattr 190 7         removexattr 197 14
lremovexattr 198 15   fremovexattr 199 16     truncate 76 45
mknod 133 -           mknodat 259 33          symlink 88 -            symlinkat 266 36
link 86 -             linkat 265 37           mount 165 40            umount2 166 39
move_mount 429 429    open_tree 428 428       fsopen 430 430          fspick 433 433
fsmount 432 432       mount_setattr 442 442   pivot_root 155 41       chroot 161 51
unshare 272 97        setns 308 268           open_by_handle_at 304 265
fanotify_init 300 262 add_key 248 217         request_key 249 218     keyctl 250 219
inotify_init 253 -    inotify_init1 294 26    inotify_add_watch 254 27
reboot 169 142        kexec_load 246 104      kexec_file_load 320 294
init_module 175 105   finit_module 313 273    delete_module 176 106
settimeofday 164 170  clock_settime 227 112   adjtimex 159 171
clock_adjtime 305 266 sethostname 170 161     setdomainname 171 162   swapon 167 224
swapoff 168 225       acct 163 89             quotactl 179 60
quotactl_fd 443 443   syslog 103 116          iopl 172 -              ioperm 173 -
"""
_NEWER = 451  # newer system calls are unknown here and to today's Python
_PRLIMIT, _PRCTL = (302, 261), (157, 167)
_PDEATHSIG = 1  # the prctl option that ends it with the checker: set and kept
# Calls that do many things, and which of them are left (the second argument).
# fcntl: F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_DUPFD_CLOEXEC: no lock, lease, signal.
# ioctl: FIONCLEX, FIOCLEX: it changes a file's flags though that is open for reading.
_COMMANDS = {(72, 25): (0, 1, 2, 3, 1030), (16, 29): (0x5450, 0x5451)}
_MACHINES = {
    "x86_64": (0, 0xC000003E),
    "aarch64": (1, 0xC00000B7),
}  # column above, <linux/audit.h>
_NUMBER = 0  # offsets in struct seccomp_data
_ARCH = 4
_FIRST_ARGUMENT = 16
_SECOND_ARGUMENT = 24
_LOAD = 0x20
_IF_EQUAL = 0x15
_IF_AT_LEAST = 0x35
_RETURN = 0x06
_ALLOW = 0x7FFF0000
_KILL = 0x80000000
_EPERM = 0x50001
_ENOSYS = 0x50026
_NO_NEW_PRIVS, _SET_SECCOMP, _FILTER = 38, 22, 2  # <linux/prctl.h>

Instruction = tuple[int, int, int, int]  # code, skip if true, skip if false, operand


class _Program(ctypes.Structure):
    _fields_ = [("length", ctypes.c_ushort), ("code", ctypes.c_char_p)]


def known() -> bool:
    """Return whether there is a filter for this system."""
    return sys.platform.startswith("linux") and (
        platform.machine() in _MACHINES and sys.maxsize > 2**32
    )


def close() -> bool:
    """Refuse those calls to this process for good; return whether the kernel does."""
    if not known():
        return False
    code = b"".join(
        what.to_bytes(2, "little") + bytes((so, other)) + operand.to_bytes(4, "little")
        for what, so, other, operand in _program(*_MACHINES[platform.machine()])
    )
    try:
        libc = ctypes.CDLL(None)
        program = _Program(len(code) // 8, code)
        libc.prctl(_NO_NEW_PRIVS, 1, 0, 0, 0)
        return libc.prctl(_SET_SECCOMP, _FILTER, ctypes.byref(program), 0, 0) == 0
    except (OSError, AttributeError):
        return False


def _program(column: int, machine: int) -> list[Instruction]:
    """Return the filter for a processor."""
    words = _REFUSED.split()
    rows = zip(*(words[start::3] for start in range(3)), strict=True)
    numbers = [int(row[1 + column]) for row in rows if row[1 + column] != "-"]
    return [
        (_LOAD, 0, 0, _ARCH),
        (_IF_EQUAL, 1, 0, machine),
        (_RETURN, 0, 0, _KILL),
        (_LOAD, 0, 0, _NUMBER),
        (_IF_AT_LEAST, 0, 1, _NEWER),
        (_RETURN, 0, 0, _ENOSYS),
        *(i for number in numbers for i in _answer(number, _EPERM)),
        (_IF_EQUAL, 0, 4, _PRCTL[column]),
        (_LOAD, 0, 0, _FIRST_ARGUMENT),
        *_answer(_PDEATHSIG, _EPERM),
        (_RETURN, 0, 0, _ALLOW),
        (_IF_EQUAL, 0, 4, _PRLIMIT[column]),
        (_LOAD, 0, 0, _FIRST_ARGUMENT),
        (_IF_EQUAL, 1, 0, 0),  # the process itself
        (_RETURN, 0, 0, _EPERM),
        (_RETURN, 0, 0, _ALLOW),
        *(i for number in _COMMANDS for i in _only(number[column], _COMMANDS[number])),
        (_RETURN, 0, 0, _ALLOW),
    ]


def _only(number: int, commands: tuple[int, ...]) -> list[Instruction]:
    """Return what refuses all commands of a call but some."""
    allowed = [i for command in commands for i in _answer(command, _ALLOW)]
    start = [(_IF_EQUAL, 0, 2 + len(allowed), number), (_LOAD, 0, 0, _SECOND_ARGUMENT)]
    return [*start, *allowed, (_RETURN, 0, 0, _EPERM)]


def _answer(number: int, answer: int) -> list[Instruction]:
    return [(_IF_EQUAL, 0, 1, number), (_RETURN, 0, 0, answer)]

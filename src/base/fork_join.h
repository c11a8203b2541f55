#pragma once
// What ThreadSanitizer must be told of oneTBB: the distribution's library is built without it, so
// that the order between the maker of a task and its runner, and between the runner and the one who
// waits, is not seen. In other builds nothing is done.

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define __SANITIZE_THREAD__ 1
#include <sanitizer/tsan_interface.h>
#endif
#endif

namespace yat {

#if defined(__SANITIZE_THREAD__)
inline char joined_token;

/// Destroyed by whoever gave out work when all of it has ended.
struct ForkJoin {
  ForkJoin() = default;
  ~ForkJoin() { __tsan_acquire(&joined_token); }
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;
};

/// A task's body. oneTBB copies it where it splits a range. Its address is the token of the order
/// between who wrote it and who reads it, and who writes another one there when it has been freed.
template <class F>
struct ForkedBody {
  F& f;
  explicit ForkedBody(F& body) : f(body) { __tsan_release(this); }
  ForkedBody(const ForkedBody& other) : f((__tsan_acquire(this), other.acquired())) {
    __tsan_release(this);
  }
  ForkedBody& operator=(const ForkedBody&) = delete;

  F& acquired() const {
    auto* const token = const_cast<ForkedBody*>(this);
    __tsan_acquire(token);
    F& body = f;
    __tsan_release(token);
    return body;
  }
  template <class... Args>
  void operator()(Args&&... args) const {
    acquired()(args...);
    __tsan_release(&joined_token);
  }
};
#else
struct ForkJoin {
  ForkJoin() {}  // Not trivial, so that an object of it is no unused variable.
};
template <class F>
struct ForkedBody {
  F& f;
  explicit ForkedBody(F& body) : f(body) {}
  template <class... Args>
  void operator()(Args&&... args) const {
    f(args...);
  }
};
#endif

}  // namespace yat

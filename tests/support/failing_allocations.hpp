#pragma once

// Lets one allocation by operator new fail, whoever makes it: the program, a library that it is
// linked to or has loaded. A test that uses it lists support/failing_allocations.cpp as a source.

namespace harpoon::test {

/// The n-th allocation of this thread from now on fails, the first being number 0. Once.
void fail_allocation(long n);
/// Whether it has; from now on none fails.
bool allocation_has_failed();

}  // namespace harpoon::test

#pragma once
// Where the program's integers of any size are kept.

namespace sightline::app {

/// From here on GMP's numbers take their memory from lists of small blocks, one for each thread and size, as numbers
/// come and go by the million: a tenth to a fifth of the time of what is exact. Blocks are kept for later numbers, not
/// given back. Where memory runs out, `end_without_memory` is called, which must not return: GMP would abort. Where it
/// is not known how much malloc gives, numbers take what malloc gives; under sanitizers nothing changes.
void keep_numbers_in_small_blocks(void (*end_without_memory)());

}  // namespace sightline::app

// GALET_INLINE: for the few functions of an inner loop whose call would cost more than they do, and whose arguments are
// constants only where they are called from.
#pragma once

#if defined(__GNUC__)
#define GALET_INLINE [[gnu::always_inline]] inline
#else
#define GALET_INLINE inline
#endif

//! Family 4: a fixed-step scheme absorbs the Zeno sequence of the bouncing ball.

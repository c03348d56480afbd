//! Brains without a map: the baselines of MSLST, and Q-learning.

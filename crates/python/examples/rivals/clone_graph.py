"""A clone-structured cognitive graph: a hidden Markov model whose looks have states of their own.

Source: George, Rikhye, Gothoskar, Guntupalli, Dedieu, Lázaro-Gredilla, "Clone-structured graph
representations enable flexible learning and vicarious evaluation of cognitive maps", Nature
Communications 12 (2021), section Methods: transitions that depend on the action, a fixed emission,
EM with a pseudocount, then Viterbi training without.
"""

import numpy as np

# As the authors' public code has them (github.com/vicariousinc/naturecomm_cscg).
PSEUDOCOUNT, EM_STEPS, VITERBI_STEPS = 2e-3, 1000, 100
# EM ends where a step gains less than this for each move, in bits. Theirs ends where single
# precision shows no gain.
GAIN = 1e-5


class CloneGraph:
    """The model: `transitions[action, before, after]`, with `clones[look]` states for each look."""

    def __init__(self, clones, actions, seed):
        self.starts = np.concatenate([[0], np.cumsum(clones)])
        states = self.starts[-1]
        self.counts = np.random.default_rng(seed).random((actions, states, states))
        self.normalize(PSEUDOCOUNT)

    def normalize(self, pseudocount):
        """Make chances of counts, given the action, as in the authors' code."""
        counts = self.counts + pseudocount
        sums = counts.sum(axis=2, keepdims=True)
        self.transitions = counts / np.where(sums > 0, sums, 1)

    def states_of(self, look):
        return slice(self.starts[look], self.starts[look + 1])

    def block(self, looks, actions, at):
        """Return the chances of move `at`, between the clones of its two looks."""
        return self.transitions[actions[at], self.states_of(looks[at]), self.states_of(looks[at + 1])]

    def forward(self, looks, actions):
        """Return the belief after each look, and the log₂-likelihood."""
        clones = self.starts[looks[0] + 1] - self.starts[looks[0]]
        beliefs, bits = [np.full(clones, 1 / clones)], 0.0
        for at in range(len(actions)):
            belief = beliefs[-1] @ self.block(looks, actions, at)
            total = belief.sum()
            bits += np.log2(total)
            beliefs.append(belief / total)
        return beliefs, bits

    def expectation(self, looks, actions):
        """Count the transitions to expect. Return the log₂-likelihood."""
        beliefs, bits = self.forward(looks, actions)
        self.counts[:] = 0
        back = np.ones(len(beliefs[-1]))
        for at in range(len(actions) - 1, -1, -1):
            block = self.block(looks, actions, at)
            joint = beliefs[at][:, None] * block * back
            before, after = self.states_of(looks[at]), self.states_of(looks[at + 1])
            self.counts[actions[at], before, after] += joint / joint.sum()
            back = block @ back
            back /= back.sum()
        return bits

    def learn(self, looks, actions):
        """Learn by EM and then by Viterbi training. Return the log₂-likelihood."""
        actions, before = np.asarray(actions, int), -np.inf
        for _ in range(EM_STEPS):
            bits = self.expectation(looks, actions)
            self.normalize(PSEUDOCOUNT)
            if bits - before < GAIN * len(actions):
                break
            before = bits
        before = -np.inf
        for _ in range(VITERBI_STEPS):
            states, bits = self.viterbi(looks, actions)
            self.counts[:] = 0
            np.add.at(self.counts, (actions, states[:-1], states[1:]), 1)
            self.normalize(0)
            if bits <= before:
                break
            before = bits
        return bits

    def viterbi(self, looks, actions):
        """Return the likeliest states, and the log₂ of their chance."""
        with np.errstate(divide="ignore"):
            best = np.zeros(self.starts[looks[0] + 1] - self.starts[looks[0]])
            chosen = []
            for at in range(len(actions)):
                joint = best[:, None] + np.log2(self.block(looks, actions, at))
                chosen.append(joint.argmax(axis=0))
                best = joint.max(axis=0)
        states = [int(best.argmax())]
        for chose in reversed(chosen):
            states.append(int(chose[states[-1]]))
        states = np.array(states[::-1]) + self.starts[np.array(looks)]
        return states, float(best.max())

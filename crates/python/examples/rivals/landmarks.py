"""Where the robot stood when it noticed landmarks."""

import numpy as np


class Landmarks:
    """Landmarks, each in the middle of the box around where it was noticed."""

    def __init__(self, apart):
        self.apart, self.boxes = apart, []

    def note(self, landmark, position):
        """Note a landmark, which is another one if the last of its name is far off."""
        if not landmark:
            return
        here = np.array(position[:2])
        for name, low, high in self.boxes:
            if name == landmark and np.all(np.abs((low + high) / 2 - here) < self.apart):
                low[:], high[:] = np.minimum(low, here), np.maximum(high, here)
                return
        self.boxes.append((landmark, here.copy(), here.copy()))

    def all(self):
        """Return names and positions."""
        return [(name, (low + high) / 2) for name, low, high in self.boxes]

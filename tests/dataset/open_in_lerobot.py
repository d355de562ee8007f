# SPDX-License-Identifier: BSD-3-Clause
"""Open a dataset by the official loader, in a Python that has lerobot, and write what it gives.

    python open_in_lerobot.py DATASET OUTPUT.npz

lerobot 0.4 reads v2.1 after its own converter, in place. Features of the hub are off.
"""

import json
import sys
from importlib.metadata import version
from pathlib import Path

import numpy as np
from lerobot.datasets.lerobot_dataset import LeRobotDataset


def _opened(root: Path) -> LeRobotDataset:
    name = f"{root.parent.name}/{root.name}"
    stated = json.loads((root / "meta" / "info.json").read_text(encoding="utf-8"))["codebase_version"]
    if stated == "v2.1" and not version("lerobot").startswith("0.3."):
        from lerobot.datasets.v30.convert_dataset_v21_to_v30 import convert_dataset

        convert_dataset(name, root=root.parent.parent, push_to_hub=False)
    return LeRobotDataset(name, root=root)


def main(root: Path, output: Path) -> None:
    """Write every item of every feature, and the statistics, as a policy gets them."""
    dataset = _opened(root)
    items = [dataset[k] for k in range(len(dataset))]
    values = {key: np.stack([item[key].numpy() for item in items]) for key in dataset.features}
    stats = {
        f"stats/{key}/{name}": np.asarray(value)
        for key, own in dataset.meta.stats.items()
        for name, value in own.items()
    }
    np.savez(
        output,
        **values,
        **stats,
        tasks=[item["task"] for item in items],
        episodes=dataset.num_episodes,
        fps=dataset.fps,
    )


main(Path(sys.argv[1]), Path(sys.argv[2]))

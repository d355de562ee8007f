// SPDX-License-Identifier: BSD-3-Clause
// Written by `make web-types` from src/forcetorque/results/visual_roles.py; change that file instead.

export const ROLES = {
  "expected": {
    "word": "expected",
    "colours": [
      "#000000",
      "#ffffff"
    ],
    "dash": []
  },
  "prior": {
    "word": "prior",
    "colours": [
      "#747b85",
      "#9aa3af"
    ],
    "dash": [
      4.0,
      2.0
    ]
  },
  "calibration-1": {
    "word": "calibration",
    "colours": [
      "#0072B2",
      "#56b4e9"
    ],
    "dash": []
  },
  "calibration-2": {
    "word": "second calibration",
    "colours": [
      "#D55E00",
      "#f08a3c"
    ],
    "dash": [
      6.0,
      2.0
    ]
  },
  "calibration-3": {
    "word": "third calibration",
    "colours": [
      "#009E73",
      "#2fc79b"
    ],
    "dash": [
      6.0,
      2.0,
      1.0,
      2.0
    ]
  },
  "calibration-4": {
    "word": "fourth calibration",
    "colours": [
      "#CC79A7",
      "#e3a0c6"
    ],
    "dash": [
      2.0,
      1.5
    ]
  },
  "calibration-5": {
    "word": "fifth calibration",
    "colours": [
      "#665200",
      "#ffc04d"
    ],
    "dash": [
      6.0,
      2.0,
      1.0,
      2.0,
      1.0,
      2.0
    ]
  },
  "calibration-6": {
    "word": "sixth calibration",
    "colours": [
      "#5b2a86",
      "#b7a3e3"
    ],
    "dash": [
      1.0,
      1.0
    ]
  },
  "contact": {
    "word": "contact",
    "colours": [
      "#7a4a00",
      "#d9a25f"
    ],
    "dash": []
  },
  "limit": {
    "word": "limit",
    "colours": [
      "#c1121f",
      "#ff6b6b"
    ],
    "dash": [
      4.0,
      3.0
    ]
  },
  "finding": {
    "word": "finding",
    "colours": [
      "#b04a00",
      "#ff9d5c"
    ],
    "dash": []
  },
  "skin": {
    "word": "contact on skin",
    "colours": [
      "#882255",
      "#e08bb4"
    ],
    "dash": []
  },
  "heuristic": {
    "word": "heuristic contact",
    "colours": [
      "#5b6472",
      "#a9b2c0"
    ],
    "dash": [
      1.0,
      2.0
    ]
  },
  "axis-x": {
    "word": "x",
    "colours": [
      "#d0312d",
      "#ff7b72"
    ],
    "dash": []
  },
  "axis-y": {
    "word": "y",
    "colours": [
      "#2a8a3c",
      "#5fd075"
    ],
    "dash": []
  },
  "axis-z": {
    "word": "z",
    "colours": [
      "#2b5fd0",
      "#82aaff"
    ],
    "dash": []
  },
  "use-calibration": {
    "word": "calibration",
    "colours": [
      "#3a8fc4",
      "#3d8fc0"
    ],
    "dash": []
  },
  "use-validation": {
    "word": "validation",
    "colours": [
      "#009e73",
      "#1f9c78"
    ],
    "dash": []
  },
  "use-ignore": {
    "word": "ignored",
    "colours": [
      "#8a8f98",
      "#7d838d"
    ],
    "dash": []
  },
  "tone-good": {
    "word": "use",
    "colours": [
      "#00654a",
      "#4ed1a5"
    ],
    "dash": []
  },
  "tone-caution": {
    "word": "caution",
    "colours": [
      "#8a5a00",
      "#f0b64a"
    ],
    "dash": []
  },
  "tone-bad": {
    "word": "refuse",
    "colours": [
      "#a33c00",
      "#ff8f5c"
    ],
    "dash": []
  },
  "tone-unknown": {
    "word": "unknown",
    "colours": [
      "#4b5560",
      "#aab3be"
    ],
    "dash": []
  }
} as const;

export const SURFACES = {
  "ink": [
    "#1f2430",
    "#e8ebf0"
  ],
  "muted": [
    "#59606c",
    "#a4acb9"
  ],
  "line": [
    "#d8dce3",
    "#3a4150"
  ],
  "border": [
    "#7b8390",
    "#7d8694"
  ],
  "guide": [
    "#c9ced6",
    "#4a5263"
  ],
  "grid": [
    "#e9ecf1",
    "#2a303c"
  ],
  "ground": [
    "#f4f6f8",
    "#12151b"
  ],
  "panel": [
    "#ffffff",
    "#1b1f27"
  ],
  "hover": [
    "#eef3f7",
    "#2a313d"
  ],
  "chosen": [
    "#dcecf6",
    "#1d3a52"
  ],
  "accent": [
    "#0069a6",
    "#5cb8f0"
  ],
  "on-accent": [
    "#ffffff",
    "#0c1218"
  ],
  "link": [
    "#005c91",
    "#7cc7f5"
  ],
  "note": [
    "#fff7e0",
    "#3a3115"
  ],
  "note-border": [
    "#b87f00",
    "#a8842a"
  ],
  "shadow": [
    "#00000033",
    "#000000aa"
  ],
  "sky": [
    "#ffffff",
    "#ffffff"
  ],
  "earth": [
    "#b9bec8",
    "#9aa1ad"
  ]
} as const;

export const PRESSURES = [
  "#f3efe6",
  "#f2c14e",
  "#d1495b",
  "#3b0f70"
] as const;

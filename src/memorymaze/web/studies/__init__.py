"""Studies with people: the pages they meet, what they answer, and corpora made of it.

Holds study files, the store of answers, the pages of participants and experimenter, and the
export. `follow` has people drive a robot, `interviews` a tablet and recordings, `labels`
what descriptions say on the plan. Does not hold labels of finished texts (`texts.labels`),
what all pages need (`serving`), nor what runs or tables are made of.

Nothing is imported here: only the verbs that serve pages need the extra `studies`.
"""

"""The vocabulary of English route descriptions: which words do which work.

Each entry of `PATTERNS` is a kind of chunk and a pattern over lower-case text; at each
place the first pattern that matches wins. Words that no pattern claims are content
words, from which the names of things are made.
"""

__all__ = ["CLOCK", "ORDINALS", "PATTERNS", "SIDES", "SURFACES", "UNSEEN"]

ORDINALS: dict[str, int] = {
    "first": 1, "1st": 1, "next": 1, "nearest": 1, "very next": 1, "very first": 1,
    "second": 2, "2nd": 2, "third": 3, "3rd": 3, "fourth": 4, "4th": 4,
    "fifth": 5, "5th": 5, "sixth": 6, "6th": 6, "seventh": 7, "7th": 7,
    "eighth": 8, "8th": 8, "last": -1, "very last": -1, "final": -1,
}  # fmt: skip

CLOCK: dict[str, str] = {
    "twelve": "forward", "12": "forward", "one": "slight_right", "1": "slight_right",
    "two": "slight_right", "2": "slight_right", "three": "right", "3": "right",
    "four": "right", "4": "right", "six": "behind", "6": "behind", "eight": "left",
    "8": "left", "nine": "left", "9": "left", "ten": "slight_left",
    "10": "slight_left", "eleven": "slight_left", "11": "slight_left",
}  # fmt: skip

SIDES = ("left", "right")

_side = r"(?:left|right)"
_no_side = r"(?!\s*(?:left|right)\b)"
_way = (
    r"(?:t-?junctions?|y-?junctions?|junctions?|intersections?|cross(?:ing|ings)|cross[ -]?roads?"
    r"|openings?|turnings?|turns?|turn-?offs?|corridors?|hallways?|halls?|passage(?:way)?s?"
    r"|walkways?|ways?|streets?|paths?|gaps?|lanes?|branch(?:es)?|roads?|aisles?|alleys?|forks?"
    r"|corners?|bends?|route|exits?|hall way|crossroad|four-way(?: crossing)?|t)"
)

PATTERNS: tuple[tuple[str, str], ...] = (
    # -- punctuation and lists
    (".", r"[.!?;\n]+"),
    (",", r"[,:()\[\]\"/=|…]+|--+|\s[-–—]+\s"),
    # -- fillers that contain words of other kinds
    ("f", r"(?:all right|alright|(?<![\s\S])right,? (?:so|okay|ok|then|well|um|uh)\b|ok right|that's right|yes,? right|let me get this right|is that right|to be right)\b(?!\s+(?:turn|hand))"),
    ("f", r"(?<=[.!?]\s)that's right(?= *[.!?])"),
    ("f", r"right (?=(?:in front|ahead|opposite|next to|beside|across from|behind|underneath|above|in the middle|out of your)\b)(?!right in the)"),
    ("f", r"by the way|a long way|the whole way|on the way(?: (?:there|back))?|in the way|some way|any ?way|no way to miss|ways? off|each way|one way or another|the way (?:the|it|i)\b"),
    ("f", r"(?:this|that|the other) one\b"),
    ("f", r"(?:this|that|the same|the right|the correct) way\b(?! (?:on|off))"),
    ("f", r"(?:at|in|for) (?:least|last|first|once more|general|detail|short|total|front of you then)\b"),
    ("f", r"you(?:'ve| have)? (?:can't|cannot|can not|couldn't|won't) (?:miss|go wrong)(?: (?:it|him|that|this))?|can(?:'t|not) miss (?:it|him|that)|impossible to miss|hard to miss"),
    ("f", r"(?:is|was) (?:that|it) (?:ok(?:ay)?|right|good|clear|too fast|better|understandable)[^.?!]*"),
    ("f", r"(?:have|has|had|'ve) left\b"),
    ("f", r"(?:the |your |this |a )?robot(?! (?:should|will|would|may|might|must|can) be\b)(?= (?:should|can|could|may|might|will|would|must|needs?|has to|looks?|sees?|finds?|reads?|detects?|turns?|goes|go|advances?|checks?|spots?|follows?|walks?|moves?|feels?|search(?:es)?|wants?|passes|keeps?|please|now|then|just|simply|reach(?:es)?|gets|takes?|comes?)\b)|(?:for|help|tell|ask|let|have|make|if|explaining|remind|instruct) (?:the |your |a |this )?robot\b|robot's|robot:"),
    ("W", r"first[ -]aid\b|no[ -]entry\b|no smoking\b"),
    # -- self-correction and overshoot
    ("C", r"(?:oh |ah |well |ugh |um |uh )*(?:no,? )*(?:no wait|wait,? no|wait wait|wait|(?:i'm )?(?:so |very )?sorry|pardon|i beg your pardon|excuse me|forgive me|correction|scratch that|hang on|hold on|my mistake|what am i saying|i (?:say|said) (?:it )?wrong|i (?:said|say) (?:left|right)(?: before| earlier| first)?|i mean(?:t)?|or rather|rather|rubbish|nonsense|i tell a lie|other (?:hand|side|way)|make that|oh no|well no|no no|strike that|silly me|let me correct (?:that|myself)|to the contrary|on the contrary|actually)\b(?: no\b)*"),
    ("o", r"(?:(?:gone|went|go|going|walked|walk|been|be|come|are|is|was|it's|that's|you're|it was|step|way|little|bit|touch|just|much) )?(?:a (?:bit|little|touch|step) |slightly |much |one opening |one step )?(?:too far|too much|too late|overshot|overdone|over ?shoot|past it|gone past)\b"),
    ("o", r"(?:have |has |had |'ve |already )*(?:missed|passed|blown past|walked past) (?:it|the turn(?:ing)?|your turn(?:ing)?|the opening)\b|miss (?:it|that|this)\b|means? you(?:'ve| have)? missed"),
    ("o", r"(?:turn|come|go|walk|get|step) back\b|turn round|back up|return (?:a (?:few|little|bit)|some)|overshot|wrong (?:way|side|turn|corridor|hall|place|direction)|(?:is|are|be|was) (?:a )?(?:wrong|mistake)(?: as well| too)?|too far|you (?:will|would|'d|'ll|'ve)? ?(?:end|ended) up|they(?:'ll| will) send you back"),
    # -- forced ways
    ("f", r"(?:keep(?:s|ing)?|stay(?:s|ing)?|stick(?:s|ing)?|hug(?:s|ging)?|close)(?: straight)? (?:to |on |at |along |by |near )?(?:the |your )?(?:left|right)(?:[- ]?hand)?(?: (?:hand )?side| wall)?\b(?! (?:at|and|then|until|turn))"),
    ("D", r"by (?:it|him|her)?self|by themselves|on its own|automatic(?:ally)?\b(?= *[.,;])|that's automatic|turns? (?:alone|by alone)|alone\b|naturally|no (?:other )?(?:choice|option|way|alternative)(?: (?:but|to go|else))?|other way does not exist|there (?:is|'s) no other way|only way|nowhere else|can(?:'t| ?not) go anywhere else|without choosing(?: anything)?|nothing to decide|(?:it is|it's|that is|that's) not (?:really )?a (?:real )?turn(?:ing)?|one can only go|you can only go|(?:it )?only goes"),
    ("D", r"only(?= (?:left|right)\b)"),
    # -- ends of a way
    ("E", r"(?:at|to|till|until|'til|up to|towards?|reach|near|by) (?:the |it's |its |that |this )?(?:very |far |other )*(?:end|ends|finish|dead ?end)\b(?: of (?:the |this |that |it|its|your )?(?:whole )?(?:\w+ ){0,2}?(?:corridor|hallway|hall|passage(?:way)?|way|street|path|lane|road|aisle|alley|it|that|this|row|bridge|link|carpet)\b)?(?: is reached)?"),
    ("E", r"(?:when|where|until|till|once|before|as|because)? ?(?:it|this|that|the (?!glass|carpet|tile|tiles|brick|bricks|wood|floor|lino|wall|walls|concrete)\w+|the \w+ (?!glass|carpet|tile|tiles|brick|bricks|wood|floor|lino|wall|walls|concrete)\w+|corridor|hallway|path|lane|road|passage|he|there)(?:'s| is| has| are)? ?(?:just |simply |all )?\b(?:ends?|ended|stops?|stopped|finish(?:es)?|finished|is over|over|done|runs out|comes to an end|closed)\b(?: (?:in|at|with) (?:a |the )?wall)?"),
    ("E", r"(?:when|where|until|till) (?:it|this|that|the \w+)(?:'s)? (?:splits?|forks?|divides?|branches)\b(?: (?:in|into|to))?(?: (?:the )?left (?:and|or) (?:the )?right| two\b)?"),
    ("E", r"(?:until|till|to where|so far|as far as|when|where)? ?(?:you|one|we|it|i)? ?(?:can(?:'t|not| not)?|could ?n[o']t|are not able to|cannot) (?:not |no longer |only )?(?:go|walk|move|continue|get)?(?: straight| on| forward| ahead| further| any ?further| farther)+(?: any ?more| any ?further| ahead)?"),
    ("E", r"no (?:more|further) (?:straight|forward|ahead|corridor)|as far as (?:it|you|this|that|the \w+) (?:goes?|can(?: go)?|will go)"),
    ("E", r"(?:(?:until|till|to|at|hit|hits|reach|meet|face|facing|against|up against|come (?:up )?(?:to|against)|comes? to|there(?:'s| is)|towards?|into|is|then|before) )(?:a |the |an |another |that )?(?:cross |end |blank |back |plain |far |dead )*wall\b(?! (?:on|at|to|along|with (?:your|the) hand|beside|by|side|picture|painting))(?: (?:ahead|in front(?: of you)?))?"),
    ("E", r"(?:the )?wall (?:ahead|in front(?: of you)?|is in front(?: of you)?|straight ahead|blocks)|dead[- ]end|(?:it|this|that|corridor|hallway|path|lane|way) (?:ends?|stops)\b|far end\b|very end\b|\bthe end\b|\bits end\b|end of (?:the |this |that |it)?(?:\w+ )??(?:corridor|hallway|hall|passage(?:way)?|way|street|path|lane|road|aisle|alley|row|it|that|this)\b|\bend\b(?= *[,:.;])|^end\b"),
    ("E", r"all the way(?: (?:up|down|along|through|to the end|there|on|over))*|(?:(?:you|it|one|we)? ?(?:can|could|only|just|either|goes?|divides?|splits?|turn)(?: only| in| into| to| go| either)* )?(?:left or right|right or left)\b(?:-?hand)?|(?:in|into|to) left and right\b"),
    # -- directions
    ("2", r"(?:left|right)[- /](?:and[- ])?(?:then[- ])?(?:left|right)\b(?! hand)(?:[- ](?:combo|thing|turn|bend|jog|zigzag|shuffle))?"),
    ("S", r"(?:also|too|again on the) (?:on the )?(?:left|right)\b"),
    ("S", rf"(?:(?:on|at|in|from|along|of|with) )(?:to )?(?:the |your |its |our |my |his |their |it's |you )?(?:far |very |immediate |near |whole )?{_side}(?:[- ]?hand)?(?:[- ](?:hand )?sides?)?\b(?! (?:turn|turning|corner|end of))(?: of (?:you|him|us|yours?))?"),
    ("S", rf"(?:to|towards?|onto|into) (?:the |your |its |our |my |his )?(?:far |very |immediate )?{_side}(?:[- ]?hand)?(?:[- ]sides?)?\b(?! (?:turn|turning|wall))(?: of (?:you|him|us))?"),
    ("S", rf"{_side}[- ]?(?:hand[- ]sides?|sides?|hand(?! (?:turn|turning|opening|corridor)))\b"),
    ("S", r"(?:(?:at|on|to|towards?|from|be|in|is|a full|full|the|your|their|his) )*(?:eleven|twelve|three|four|nine|eight|six|ten|two|one|1[012]?|[2-9]) ?o'? ?clock(?: (?:side|way|direction))?"),
    ("m", r"(?:(?:on|at|to|in) )?(?:both|either|each|all|the two) (?:of the )?(?:sides?|hands?)\b|(?:on|to|at) (?:the |your )?(?:left|right) and (?:the |your |on (?:the )?|to (?:the )?)?(?:left|right)\b|left and right\b(?= (?:of|there))"),
    ("S", rf"{_side} (?=wall\b)"),
    ("d", r"(?:front|diagonal(?:ly)?|forward|half)[- ](?:to (?:the |your )?)?(?:left|right)\b(?: direction)?"),
    ("L", r"(?:slight(?:ly)?|half|soft|gentle|gently|a bit|a little|bit|little|diagonally)(?: to (?:the |your )?)?[- ](?:to (?:the )?)?(?:left|right)\b"),
    ("L", r"(?:left|right)[- ]hand(?= (?:turn|turning|opening|corridor|one|passage))|(?:left|right)(?:wards?)?\b"),
    ("i", r"straight ?away|right ?away|immediately|at once|directly(?! (?:in|ahead|opposite))|in (?:one|a single) (?:go|move(?:ment)?|turn|curve)|as (?:one|a single) (?:go|move(?:ment)?|turn|curve)|in quick succession|quick(?:ly)?|(?:almost |nearly )?(?:together|straight after)|very soon|soon(?: after)?|at the same time|instantly|one after the other|like one (?:curve|turn|move)|almost one curve|really one"),
    ("H", r"(?:straight(?:forward)?|str(?:ai|ia)gth|forwards?|ahead|fwd|foward|dead ahead|onwards?|front)\b(?: (?:on|ahead|forward|along|through|across|up|down|over))*"),
    # -- lengths are read by their own pattern before this table; ordinals
    ("O", r"(?:opening|turning|turn|junction|crossing|corridor|passage|way|street|decision|intersection) (?:number |no\.? ?|#)?(?:one|two|three|four|five|six|seven|eight|[1-9])\b(?! ?(?:m|met(?:er|re)s?|steps?|and|to|or)\b)|number (?:one|two|three|four|five|six|seven|eight|[1-9])\b"),
    ("O", r"(?:very )?(?:first|second|third|fourth|fifth|sixth|seventh|eighth|1st|2nd|3rd|[4-8]th|next|nearest|last|final)\b(?! (?:time|of all|thing|aid|floor|class|iteration|minute|week|year|then|week|to))"),
    # -- negation, ignoring, passing
    ("I", r"(?:please )?(?:kindly )?(?:ignor(?:e|es|ing|ed)|skip(?:s|ping|ped|pable)?|never mind|don't mind|disregard|forget(?: about)?|(?:don't|do not|no need to) (?:bother(?: with)?|enter|go in(?:to)?|take|mind|use|turn(?: (?:off|in|there|here))?|stop(?: (?:at|for))?|want)|pay no attention to|avoid|leave (?:it|this|that|them|those|these|out)|(?:is|are|'s|'re|was|were) not (?:for (?:you|us)|yours?|ours?|needed|important|it|this|that)|not (?:for (?:you|us)|yours?|ours?|yet|this(?: one)?|that(?: one)?|interesting|important|needed|necessary|the one|into|in there|today)|stay out of|doesn't matter|don't need|do not need|no use|can forget|can be ignored|instead of)\b"),
    ("X", r"(?:do not|don't|dont|does not|doesn't|not|never|won't|will not|shouldn't|should not|without|no need|nothing|rather than|neither|none|no)\b"),
    ("P", r"(?:go(?:es|ing)?|walk(?:ing|s)?|move|head|continue|carry on|keep going|keep|run(?:s|ning)?)? ?(?:straight )?(?:past|by(?= the (?:\w+ )*(?:on|to)\b))\b|pass(?:es|ed|ing)?(?: by| through| over| under)?\b|beyond\b"),
    # -- conditions
    ("c", r"(?:if|should (?=you|the|it|a|robot)|in case|otherwise|or else|unless|in the event)\b"),
    # -- arrival
    ("R", r"(?:you(?:'ve| have| are|'re|'ll be| will be| should be)? ?(?:now |already |then |there )?(?:arriv(?:e|ed|ing)(?: (?:to|at|in|by))?|reach(?:ed)? (?=your|the destination|the goal)|made it|got there|there(?: now)?(?= *[.,!]))|(?:we|you) arrive(?: (?:to|at|in))?|arriv(?:e|ed|es|ing)(?: (?:to|at|in))?|(?:that|this|it|here|there)(?:'s| is| will be| would be)? (?:your |the )?(?:destination|goal|target|it(?= *[.,!]))|welcome(?: to)?|stop(?: there| here)?(?= *[.,!]| at| in front| by)|your destination(?: is)?|the destination(?: is)?|the goal(?: is)?|(?:is )?the one you(?: are|'re) looking for|the place(?= *[.]))\b"),
    ("B", r"comes?(?= (?:a|an|the|one|my|your|first|second|third|next|on the|at the|another)\b)"),
    ("G", r"come(?:s)? (?:out|off|in)\b(?: of| from)?"),
    # -- taking what was named
    ("Y", r"(?:take|use|enter|go in(?:to)?|go for|want|turn(?: in)?(?: to)?|follow|choose) (?:it|this|that|this one|that one|there|here|in there)\b(?! (?:way|path|corridor|hallway|street|road|passage|lane|hall|opening|to the end|until|all|round|along|for|\w+ until))|(?:that|this|it)(?:'s| is| will be| would be) (?:the one|yours|your (?:one|turn|way)|you|ours|us|where you (?:turn|go)|the turn(?:ing)?)\b(?! (?:are|'re|go))|(?:is|'s) (?:yours|ours|the one|you want)\b|go in(?= *[.,;]| and| there)|go inside|(?:you )?enter(?= *[.,;])|you take(?= *[.,;])|you want(?= *[.,;])|(?:take|use)(?= *[.,;]|$)|go that way"),
    # -- curves
    ("K", r"(?:path|way|corridor|hallway|hall|it|passage|lane|road|he|street|gallery|floor|which|that|robot)?(?: will| just| then| simply| also| only)? ?(?:bends?|curves?|curls?|winds|wraps|goes round|goes around|bending|curving|(?:it|path|corridor|hallway|hall|lane|road|way|street|passage|which|that) (?:just |then |simply |only |will |also )*(?:turns?|goes|go|leads?|makes?|takes you|brings you|veers?|swings?))\b(?: you)?(?: (?:round|around|again|off|only|then|just))*"),
    ("K", r"(?:small|slight|gentle|little|a|the|soft)? ?(?:curve|bend|jog|zig ?zag|chicane)\b(?= (?:to|left|right))"),
    ("K", r"(?:follow|go|walk|come|goes|keep)(?:ing|s)? (?:it|this|that|the \w+|the path \w+|with it|yourself)? ?(?:round|around)\b(?! (?:them|him|here|\d|it|two|the))"),
    ("K", r"(?:round|around) (?:the|a|this|that) (?:corner|bend|curve)\b"),
    # -- verbs
    ("V", r"(?:(?:you|robot|it|we|one)(?:'ll| will| should| can| may| might| could| must)* )?(?:see(?:s|ing|n)?|find(?:s|ing)?|found|notice[sd]?|spot(?:s|ted)?|detect(?:s|ed)?|look(?:s|ing)? (?:for|at|out for)|search(?:es)?(?: for)?|meet(?:s)?|watch(?:es)?(?: for| out for)?|recogni[sz]e|check(?:s)?(?: off)?|listen (?:for|to)|hear(?:s|ing)?|smell(?:s)?|feel(?:s)?|identify|encounter|face|facing|turn to face|comes?(?: up)? to|come across|reach(?:es|ing)?|get to|arrive to|hit(?:s)?|approach|discover|scan(?:s)?(?: for)?|read(?:s)?|have|get|has)\b"),
    ("T", r"(?:opening|turning|turn|corridor|passage|way|one|path|street|hallway) (?:to take|you want|you take|we take|we want|you need|for you)(?: is| comes)?\b"),
    ("T", r"(?:means?|indicates?)(?= (?:you )?(?:turn |go )?(?:left|right)\b)"),
    ("e", r"(?:yes|yeah|yep|indeed|correct|exactly)\b"),
    ("T", r"(?:make|take|do|hang|turn|turns|turning(?= (?:left|right|to|at))|bear|veer|rotate|swing|choose|want|pick|prefer|turned|takes|makes|taking|making|bearing|enter|enters|use)\b"),
    ("G", r"(?:go|goes|going|walk|walks|walking|move|moves|moving|continue|continues|continuing|proceed|head|heading|advance|advances|travel|step|carry|keep|keeps|keeping|follow|follows|following|come|comes|coming|leave|leaves|leaving|exit|drive|get|gets|run|runs|stay|stays|cross|crosses|start|starts|return|lead|leads|leading|stroll|wander|bring|brings|roll|push)\b(?: (?:on|along|out|off|up|down|across|through|over|going|in|from|of|out of|around))*"),
    ("a", r"(?:again|another|once more|one more)\b"),
    ("B", r"(?:starts?|begins?|opens?|continues|leads)(?= (?:to|towards|on) (?:the |your )?(?:left|right))|(?:there(?:'s| is| are|'ll be| will be| should be| may be| comes| hangs| stands)|you(?:'ve| have)(?: got)?|here(?:'s| is)|(?:hangs?|stands?|comes?|lies?|sits?|appears?|follows|hums?|buzz(?:es)?|starts?|begins?) (?=on|at|to)|is|are|was|will be|would be|should be|be|'s|'re|being|should|must be|might be|may be|could be|has to be)\b"),
    ("Z", r"(?:it|that|this)(?:'s| is| will be| would be| should be| must be|'ll be)\b(?: (?:a|the|again))*|then (?:it|comes|there)(?:'s| is| comes)\b"),
    ("t", r"(?:into|onto|across(?! from)|through|over|along|down)\b"),
    ("A", r"(?:out of|out from|away from|off the)\b"),
    ("A", r"(?:at|in(?! (?:front|between|total|all|which|order|general|detail|fact|case)\b)|inside|near|next to|beside|opposite(?: of| to)?|across(?: from)?|facing|in front of|under(?:neath)?|below|when|where|as soon as|alongside|close to|by|once|between|among|from|towards?|level with|with|around)\b"),
    ("Q", r"(?:just |right |shortly |immediately |directly |only |until |a (?:bit|little) |soon )*(?:before|after|behind)\b"),
    ("U", r"(?:until|untill|till|'til|up to|as far as|so that|to)\b"),
    # -- joints
    (">", r"(?:and |& )?(?:followed by|then|after (?:that|this|it|which)|afterwards|next(?=,)|from there|from here|finally|following that|thereafter|at last|later(?: on)?|further(?: on)?|and so)\b"),
    ("r", r"so\b(?! that| far| much| many)"),
    ("&", r"(?:and|&|plus|also|but|or|while|because|since|though|although)\b"),
    ("h", r"(?:maybe|perhaps|i think|i guess|i believe|i suppose|probably|possibly|if i remember(?: correctly| right(?:ly)?)?|i'd say|i would say|not (?:100 ?%|a hundred percent|completely|totally|really|entirely|quite)? ?(?:sure|certain)(?: about (?:this|that|it))?|i'm (?:pretty |fairly |quite )?sure|might|roughly|approximately|around(?= \d)|about(?= \d)|kind of|sort of|more or less|likely|presumably|apparently)\b"),
    # -- junction nouns, alone or counted
    ("J", rf"(?:(?:side|small|big|large|little|long|short|main|wide|narrow|proper|full|new|same|other|real|sharp|tiled|open) )*{_way}\b(?! (?:machine|sign))"),
    ("J", r"(?:ones?)\b"),
)  # fmt: skip
"""(kind, pattern) pairs; kinds are explained in `chunks.py`."""

_FILLERS = """
a about able above absolutely across actual actually add again ago ah ahead all almost along already
also alternatively although altogether always am an and another any anybody anyone anything anyway
anyways anywhere apart appear appears as aside ask available away aye back bad basically bear became
because become becomes been being believe best better bit both bother break brief bring brings but bye
call called came can cannot can't care careful carefully caution certain certainly change changed
changes changing cheers clear clearly close closed come comes complete completely concentrate confirm
confirms continue continued continuously correct correctly could couldn't count counted counting counts
course current currently danger dear decent decide decision describe describes described destination did didn't
different difficult direct direction directions distance do does doesn't doing done don't down
during each earlier easily easy either else empty end ends enjoy enough entire entirely especially
essentially even eventually ever every everybody everyone everything everywhere exact exactly except
excuse explain expect extra facing fairly fall false familiar far farther fast few fine finish finished first fit
follow following for forever forget former forward found free from full fully further gave
general generally gently get gets getting give given gives giving go goes going gone gonna good goodness got gotta
gradually great guess had half happen happens happy hard hardly has hasn't hate have haven't having he
he'd he'll hello help helps hence her here here's hers herself hey hi him himself his hm hmm hold
honest honestly hope hopefully how however huge i i'd if i'll i'm imagine immediate in indeed
inside instead interesting into is isn't it it'd it'll its itself i've just keep kept kind kindly
knew know known knows large largely last late later least leave led less let lets let's like
liked likely literally little lol long look looked looking looks lose lost lot lots love lovely
low luck luckily made main mainly make makes making many matter may me mean meaning means meant mention
might mind mine minus miss missing mm moment moments more most mostly much must my myself name named near
nearby nearly necessarily necessary need needed needs neither never new nice nicely no nobody noise noisy none nope nor
normal normally not note nothing notice now nowhere number obvious obviously of off often oh ok okay
old on once one ones only onto open opened opens option or order ordinary other others otherwise
ought our ours ourselves out outside over overall own pardon part particular particularly parts people
perfect perfectly perhaps person place places please plus point points possible possibly practically press
pretty probably problem prompt proper properly provided pure quick quickly quiet quite rather
reach reached reaches ready real really reason recognise recognize remain remains remember repeat rest return right
route round running said same save saw say saying says second see seem seems
seen seriously several shall she should shouldn't show shown shows side sides similar simple simply since
slight slightly slow slowly small smooth so some somebody somehow someone something sometimes somewhere
soon sorry sort speaking spend spot start started starting starts stay step still stop stopping stops
story straightforward stretch stuff such suddenly suppose supposed sure surely take taken takes taking talk talking
tell tells tend than thank thanks that that'd that'll that's the their theirs them themselves then there
there'd therefore there'll there's these they they'd they'll they're they've thing things think this
those though thought through throughout thru thus tight till time times tiny to today together told too took
totally toward towards tricky tried tries true truly try trying turns twice two uh um
under understand unfortunately unless unlike until up upon ur us use used useful using usual
usually various very via view visible visit visitor wait walk walked walking walks want wanted wants was wasn't watch way
ways we we'd welcome well we'll went were we're weren't we've what whatever what's when
whenever where whereas where's wherever whether which while who whole whom whose
why will wish with within without wonder won't word words worry worries worse worst would
wouldn't wow wrong yeah yep yes yet yo you you'd you'll your you're yours yourself you've
easily warm cold loud louder quieter soft soften hums hum humming buzz buzzing buzzes hear heard hearing feel feels
bubbling rattle beep beeping ding dings ping chime chimes chiming echo echoes echoing smell smells smelling
knock knocks notice gets become becomes changes turns turned starts begin begins began leads led leading
follows keeps keeping moves moving carry carries carrying brings seems runs says read reads written write
opposite apart alongside upstairs downstairs overhead underfoot beneath above nearby
exactly roughly approximately around maybe perhaps probably
slide slides sliding-open whoosh whooshes hiss hisses speaks speak rattles chatter talking alltogether bounce
touch touches sit sits sitting longer shorter squeaks squeak echoey talks mind bother waits waiting meet meets misses knows loves cleans boom phew wow haha yay bravo tbh btw congrats congratulations ta hurray voila main key me myself husband wife niece brother sister friend friends
minute minutes second seconds metre metres meter meters step steps pace paces foot feet
north south east west northern southern eastern western
called named marked labelled labeled
standing hanging hangs theres cant dont wont ll ve re im ive lol sense trust fail stand promise super cool yen english proof lmost easy sense boom jumper manners live meeting stayed stands sits sitting waiting picturing coming standing lying leaning
""".split()
FILLERS: frozenset[str] = frozenset(_FILLERS)
"""Words that carry no direction and name nothing that a camera could see."""

SURFACES: frozenset[str] = frozenset(
    """floor floors flooring carpet carpets carpeted tile tiles tiled lino linoleum wood wooden
    concrete brick bricks wall walls ceiling plaster panel panels panelled panelling paneling
    glass glazed marble stone rubber rubbery hard rough polished wood-panelled shiny
    plain smooth surface ground underfoot window-side""".split()
)
"""Words for floors and walls: nothing to look for when nothing else is named."""

UNSEEN: frozenset[str] = frozenset(
    """noise noises voice voices sound sounds hum air wind breeze smell coffee voice silence music
    children kids people crowd visitors staff light sunlight daylight sun birds bird cold warmth
    draught draft echo footsteps steps rumble side hand minute seconds metre metres street building
    floor wing block area part place spot room-number number numbers letter direction directions
    trick tip decision idea picture detail total turn turns change changes movement shape zigzag
    letter stretch bit end start middle thing things stuff way ways junction junctions corner
    corners opening openings turning turnings corridor corridors hallway hallways passage
    passages path paths lane hall halls distance moment time times story day luck week year
    water hands feet foot shoes cane user person visitor everything anything something nothing
    noodles milk tea lunch wine exhibits exhibition view left right carpet walking walk
    half turned wheels whole choice mistake problem question help navigation instruction
    instructions destination goal target position route""".split()
)
"""Nouns that no camera finds or that are no thing at all."""
